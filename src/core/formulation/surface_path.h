#pragma once

#include <memory>
#include <vector>

#include "core/formulation/surface_winslow.h"
#include "core/formulation/target_metric.h"

namespace winslow {

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
