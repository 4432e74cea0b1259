#pragma once

#include "core/command/command.h"
#include "io/format/mesh_file.h"

/// What a mesh file says about its boundary, as options of a command: planes of symmetry slide, and
/// periodic sides move together.
///
///     const winslow::io::MeshFile file = winslow::io::read_mesh("case/constant/polyMesh");
///     winslow::Command command = move;
///     winslow::io::expand_groups(command, *file.details);
///     std::puts(winslow::io::add_file_defaults(command, file).c_str());
namespace winslow::io {

/// Replaces names of groups of markers (MarkerRoles::groups) by the names of their markers, but for
/// names that are markers too. mesh: in which the markers are.
void expand_groups(Command& command, const MarkerRoles& roles, const Topology& topology);

/// Lets the markers slide that the file calls planes of symmetry, and the pairs move together that
/// it calls periodic, and those that `more` does (the configuration of a solver), unless a marker
/// is in slide.fixed, slides or is periodic already, or moves. Does nothing for equations that know
/// no geometry of the boundary. Returns a sentence on what was added, and on pairs that cannot be
/// used: these are fixed. Empty: nothing was added.
std::string add_file_defaults(SmoothOptions& smooth, std::span<const std::string> moving,
                              const MeshFile& file, const MarkerRoles& more = {});
/// The same for a command; does nothing for one that does not smooth.
std::string add_file_defaults(Command& command, const MeshFile& file, const MarkerRoles& more = {});

}  // namespace winslow::io
