#pragma once

#include <memory>

#include "core/formulation/pointwise_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/outer_solver.h"
#include "core/outer/smooth_options.h"

namespace winslow {

/// Prepared solvers for one set of VCVs: stencil functionals and symbolic factorisations outlive a
/// command, so that a drag does not pay for them at every move of the mouse.
class SmoothingWorkspace {
 public:
  /// Outer solver for these VCVs and options; parts that are still good are kept. Valid until the
  /// next call.
  OuterSolver& prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
                       const SmoothOptions& options);

 private:
  std::shared_ptr<const VirtualControlVolumes> vcv_;
  SmoothOptions options_;
  std::unique_ptr<PointwiseWinslow> formulation_;
  std::unique_ptr<LinearSolver> linear_;
  std::unique_ptr<OuterSolver> outer_;
};

}  // namespace winslow
