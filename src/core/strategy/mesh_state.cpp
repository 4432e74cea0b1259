#include "core/strategy/mesh_state.h"

namespace winslow {

MeshState make_state(Mesh mesh) {
  if (mesh.topology->cell_dimension() == 3) return {std::move(mesh)};
  auto vcvs = std::make_shared<const VirtualControlVolumes>(mesh.topology);
  return {std::move(mesh), std::move(vcvs)};
}

}  // namespace winslow
