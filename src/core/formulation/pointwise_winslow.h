#pragma once

#include <memory>

#include "core/formulation/formulation.h"
#include "core/linear/sparse_system.h"
#include "core/vcv/stencil_functionals.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// Coefficients of the Winslow equations at one node, divided by (alpha + gamma) / 2.
struct WinslowCoefficients {
  double alpha = 1, beta = 0, gamma = 1;
};

/// The paper's operator (AIAA 2009-1362, equation 2, in integral form over each VCV):
///
///   alpha r_xx - 2 beta r_xy + gamma r_yy = 0,
///   alpha = |r_y|^2,  beta = r_x . r_y,  gamma = |r_x|^2,
///
/// with nodal coefficients outside the integral, so that at every free node
///
///   sum_k w_k (r_k - r_0) = 0,   w_k = alpha lxx_k - beta lxy_k + gamma lyy_k.
class PointwiseWinslow final : public FixedPointFormulation {
 public:
  PointwiseWinslow(const VirtualControlVolumes& vcv, int threads);

  std::string_view name() const override { return "pointwise"; }
  ResidualNorms residual(const Coordinates& x, bool clip, std::span<double> out) const override;
  Index freeze(const Coordinates& x, bool clip, SparseSystem& out) const override;

  /// Coefficients at a free node. Where the nodal Jacobian vanishes: those of the Laplacian.
  WinslowCoefficients coefficients(const Coordinates& x, Index node) const;
  /// Weights of a free node's neighbours (as many as it has). Returns the number of negative ones;
  /// with clip they are set to zero.
  Index weights(const Coordinates& x, Index node, bool clip, std::span<double> out) const;

 private:
  std::shared_ptr<const Topology> topology_;
  StencilFunctionals functionals_;
  FreeNodePattern pattern_;
  int threads_;
};

}  // namespace winslow
