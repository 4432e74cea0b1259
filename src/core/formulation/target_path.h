#pragma once

#include <memory>
#include <vector>

#include "core/formulation/target_metric.h"
#include "core/formulation/variational_winslow.h"

namespace winslow {

/// Targets on the way from the shapes that the triangles of a mesh have to those that are wanted:
/// on the geodesic between their metrics (core/formulation/target_metric.h). With its own shapes
/// for targets a mesh is the exact minimum of the energy, whatever it looks like. So a path of
/// minima begins at any valid mesh, and nothing has to be relaxed before it.
class TargetPath {
 public:
  /// end: with the targets that are wanted. from: a valid mesh (#nodes by 2).
  /// threads: 0 for all cores.
  TargetPath(std::shared_ptr<const VariationalWinslow> end, const Coordinates& from, int threads);

  /// share: 0 (the shapes of `from`) to 1 (as wanted).
  std::shared_ptr<const VariationalWinslow> at_share(double share) const;

 private:
  std::shared_ptr<const VariationalWinslow> end_;
  int threads_;
  std::vector<TargetMetric> own_;  // of each triangle of the formulation, in its order
};

}  // namespace winslow
