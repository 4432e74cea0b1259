#pragma once

#include "core/formulation/surface_winslow.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/variational_winslow.h"

namespace winslow {

/// TargetPath over triangles (D = 2) or tetrahedra (D = 3).
template <int D>
class ShapePath final : public TargetPath {
 public:
  /// end: with the targets that are wanted. from: a valid mesh (#nodes by D). threads: 0 for all
  /// cores.
  ShapePath(std::shared_ptr<const SimplexWinslow<D>> end, const Coordinates& from, int threads);
  std::shared_ptr<const VariationalForm> at_share(double share) const override {
    return form_at(share);
  }
  std::shared_ptr<const SimplexWinslow<D>> form_at(double share) const;

 private:
  using Metric = std::conditional_t<D == 2, TargetMetric, Eigen::Matrix3d>;

  std::shared_ptr<const SimplexWinslow<D>> end_;
  int threads_;
  std::vector<Metric> own_;  // of each cell of the formulation, in its order
};

/// TargetPath over the triangles of a surface mesh.
class SurfacePath final : public TargetPath {
 public:
  /// end: with the targets that are wanted. from: a valid mesh.
  SurfacePath(std::shared_ptr<const SurfaceWinslow> end, const Coordinates& from);
  std::shared_ptr<const VariationalForm> at_share(double share) const override;

 private:
  std::shared_ptr<const SurfaceWinslow> end_;
  std::vector<TargetMetric> own_;  // of each cell
};

}  // namespace winslow
