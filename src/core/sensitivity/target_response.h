#pragma once

#include "core/formulation/wall_stretch.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// How the gradient of the energy of a motion depends on its walls through the targets: stretched
/// walls stretch the shapes that the elements over them keep (WallStretch). The derivative by the
/// parameters of the elements is computed once, by central differences of the targets; the chain
/// rule from the places of the nodes to the parameters is exact. So forward and transposed products
/// are of the same matrix.
class TargetResponse {
 public:
  virtual ~TargetResponse() = default;
  /// Adds to `forces` (#nodes) the rates of dE/dx if the nodes of walls move at these velocities.
  virtual void add_forces(const Coordinates& velocities, Coordinates& forces) const = 0;
  /// Adds the transpose to `out`: products of `velocities` of all nodes.
  virtual void add_transpose(const Coordinates& velocities, Coordinates& out) const = 0;
};

/// form: the workspace's, of a plane or a volume mesh, at its solution x. Null if no target depends
/// on a wall.
std::unique_ptr<const TargetResponse> target_response(const VariationalForm& form,
                                                      SmoothingWorkspace& workspace,
                                                      WallStretchDerivative walls,
                                                      const Coordinates& x);

}  // namespace winslow
