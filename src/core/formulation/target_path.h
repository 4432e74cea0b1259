#pragma once

#include "core/formulation/target_metric.h"
#include "core/formulation/variational_form.h"

namespace winslow {

/// TargetPath over triangles (D = 2) or tetrahedra (D = 3).
template <int D>
class ShapePath final : public TargetPath {
 public:
  /// end: the form with the wanted targets. from: a valid mesh (#nodes by S; S = 3 also for
  /// triangles in space). threads: 0 for all cores.
  template <int S>
  ShapePath(std::shared_ptr<const TargetForm<D>> end, const Points<S>& from, int threads);
  std::shared_ptr<const VariationalForm> at_share(double share) const override {
    return form_at(share);
  }
  std::shared_ptr<const TargetForm<D>> form_at(double share) const;

 private:
  using Metric = std::conditional_t<D == 2, TargetMetric, Eigen::Matrix3d>;

  std::shared_ptr<const TargetForm<D>> end_;
  int threads_;
  std::vector<Metric> own_;   // for each cell of the form, in its order
  std::vector<double> seen_;  // f of each term at the valid mesh; empty: the form has no guards
};

}  // namespace winslow
