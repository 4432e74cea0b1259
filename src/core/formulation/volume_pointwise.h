#pragma once

#include <memory>
#include <vector>

#include "core/formulation/nodal_operator.h"
#include "core/formulation/node_pattern.h"
#include "core/formulation/volume_functionals.h"
#include "core/problem/equation_problem.h"
#include "core/problem/node_problem.h"

namespace winslow {

/// The paper's operator in space (AIAA 2009-1362, sections IV and V), in integral form over each
/// VCV and with nodal coefficients outside the integral: at every free node
///
///   sum_k w_k (r_k - r_0) = 0,   w_k = K : L_k,   K = winslow_tensor(), L_k the flux functionals.
///
/// Clipped: with negative weights set to zero.
class VolumePointwise final : public NodeProblem<FixedPointProblem> {
 public:
  /// classes: which nodes move. threads: 0 for all cores; no result depends on it. Throws
  /// UsageError for nodes that slide.
  VolumePointwise(const VolumeVcvs& vcvs, std::shared_ptr<const NodeClasses> classes, int threads,
                  bool clipped = false);

  /// The same with negative weights set to zero, or with all weights as they are.
  VolumePointwise clipped(bool clip) const;
  /// The same over other VCVs of the same topology; the pattern stays the same object.
  VolumePointwise with_vcvs(const VolumeVcvs& vcvs) const;

  std::string_view name() const override { return "pointwise"; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  /// One matrix for the three coordinates, its rows scaled by the sum of their weights' magnitudes.
  Index freeze(const Coordinates& x, SparseSystem& out) const override;
  /// With the coefficients frozen, as in freeze().
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;

  /// Weights of a free node's neighbours (as many as it has). Returns the number of negative ones;
  /// clipped, they are set to zero.
  Index weights(const Coordinates& x, Index node, std::span<double> out) const;

 private:
  template <typename Visit>
  void each_row(const Coordinates& x, Visit&& visit) const;

  std::shared_ptr<const VolumeFunctionals> functionals_;
  std::shared_ptr<const NodePattern> pattern_;
  bool clip_;
};

/// Both variants of a pointwise problem.
ClipVariants<FixedPointProblem> clip_variants(const VolumePointwise& problem);

}  // namespace winslow
