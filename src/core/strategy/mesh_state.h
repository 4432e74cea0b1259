#pragma once

#include <memory>

#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

struct SurfaceShape;

/// A mesh with all that says how it is to be smoothed: what runs and commands act on.
struct MeshState {
  Mesh mesh;
  std::shared_ptr<const VirtualControlVolumes> vcv;  ///< null: a volume mesh
  /// Layers that were inserted; if held, their spacing is kept whatever moves. Null: none.
  std::shared_ptr<const LayerStack> layers = nullptr;
  /// VCVs of a volume mesh that were given by hand. Null: none.
  std::shared_ptr<const SphereStencils> sphere_vcvs = nullptr;
  /// What the nodes of a surface mesh stay on, from the first smoothing on. Null: not found yet, or
  /// another kind of mesh.
  std::shared_ptr<const SurfaceShape> surface = nullptr;
};
/// A state with the paper's VCVs of a plane or surface mesh: equal angles, unit edges.
MeshState make_state(Mesh mesh);

}  // namespace winslow
