#pragma once

#include <filesystem>

#include "core/command/command.h"
#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"

namespace winslow::gui {

/// Writes the result of a command bit by bit. The files can be read only on the machine that wrote
/// them. before: the input state of the command; connectivity, VCVs and layers that the command did
/// not change are not written again; empty: everything is written. Atomic. Throws OutputError.
void write_step(const std::filesystem::path& path, const MeshState& state, const MeshState& before,
                const SmoothResult& smooth);
/// before: the same as in write_step(). Throws InputError for a file that is missing, truncated,
/// changed, or does not match `before`.
CommandResult read_step(const std::filesystem::path& path, const MeshState& before);

/// Errors in parts of a step that was read from a file; empty: none. The numbers serve as indices
/// later, without further checks.

/// Checks before the connectivity is built; building it checks the rest.
std::string fault_of(const MeshData& data);
std::string fault_of(const LayerStack& stack, const Topology& topology);
std::string fault_of(const ElementRoles& roles, const Topology& topology);
/// For a reference surface.
std::string fault_of_surface(const std::vector<Vec3>& points, const std::vector<Face>& faces);

}  // namespace winslow::gui
