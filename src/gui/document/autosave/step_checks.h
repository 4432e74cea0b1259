#pragma once

#include <string>
#include <vector>

#include "core/layers/layer_stack.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"
#include "core/vcv/virtual_control_volumes.h"

/// What is wrong with parts of a step that were read from a file; empty: nothing. Their numbers
/// serve as indices later on, where nobody looks at them again.
namespace winslow::gui {

/// Before connectivity is built, which checks the rest.
std::string fault_of(const MeshData& data);
std::string fault_of(const LayerStack& stack, const Topology& topology);
std::string fault_of(const std::vector<VirtualControlVolumes::Role>& roles);
/// Of a reference surface.
std::string fault_of_surface(const std::vector<Vec3>& points, const std::vector<Face>& faces);

}  // namespace winslow::gui
