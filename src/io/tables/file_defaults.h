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

/// Replaces names with a * by those of all markers of the meshes that they match, in the order of
/// the meshes: * stands for any characters, and so does .*, as in dictionaries of OpenFOAM. A name
/// that is a marker itself, or that matches none, stays.
void expand_patterns(Command& command, std::span<const Topology* const> topologies);

/// Commands with the names of groups and the patterns replaced by the markers of one mesh. details:
/// of its file; null: no groups.
std::vector<Command> with_names_expanded(std::vector<Command> commands,
                                         const FormatDetails* details, const Topology& topology);

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
