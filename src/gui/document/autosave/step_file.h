#pragma once

#include <filesystem>

#include "core/command/command.h"
#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"

namespace winslow::gui {

/// What commands led to, exactly: it reads back to the same bits. Files are for the machine that
/// wrote them.
/// before: the state that the command was given; connectivity, VCVs and layers that the command
/// left as they were are not written again; empty: the state stands for itself. Atomically. Throws
/// OutputError.
void write_step(const std::filesystem::path& path, const MeshState& state, const MeshState& before,
                const SmoothResult& smooth);
/// before: as it was written with. Throws InputError for a file that is missing, cut short,
/// changed, or does not fit the state before.
CommandResult read_step(const std::filesystem::path& path, const MeshState& before);

/// What is wrong with parts of a step that were read from a file; empty: nothing. Their numbers
/// serve as indices later on, where nobody looks at them again.

/// Before connectivity is built, which checks the rest.
std::string fault_of(const MeshData& data);
std::string fault_of(const LayerStack& stack, const Topology& topology);
std::string fault_of(const ElementRoles& roles, const Topology& topology);
/// Of a reference surface.
std::string fault_of_surface(const std::vector<Vec3>& points, const std::vector<Face>& faces);

}  // namespace winslow::gui
