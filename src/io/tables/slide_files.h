#pragma once

#include "core/command/command.h"
#include "core/geometry/sliding_boundary.h"
#include "io/format/mesh_file.h"

/// What the slide options of a command ask of files: a reference surface, which they name, and the
/// periodic sides that the file of the mesh names. Core reads no files, so that this comes before
/// execute(), which refuses a command that asks for what was not read.
///
///     const winslow::io::MeshFile file = winslow::io::read_mesh("hull.msh");
///     winslow::SmoothCommand smooth;
///     smooth.smooth.slide.markers = {"hull"};
///     smooth.smooth.slide.reference.name = "cad.stl";
///     smooth.smooth.slide.file_pairs.wanted = true;
///     winslow::Command ready = smooth;
///     winslow::io::resolve_files(ready, file.details.get());
///     state = winslow::execute(ready, winslow::make_state(file.mesh)).state;
namespace winslow::io {

/// Reads a surface mesh, or what bounds a volume mesh, of any format (read_mesh()) to slide on.
/// Throws InputError as read_mesh() does.
std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path);

/// Reads a reference surface, or has it from an earlier time.
using ReferenceReader =
    std::function<std::shared_ptr<const ReferenceSurface>(const std::filesystem::path&)>;

/// The surface that the options name; none where they name none. Throws what `read` throws.
void resolve_reference(SlideOptions& slide, const ReferenceReader& read = read_reference);
/// What the file of the mesh says of periodic sides. details: of MeshFile; null for a mesh that
/// came from no file.
void resolve_pairs(SlideOptions& slide, const FormatDetails* details);
/// Both; nothing for commands that do not smooth.
void resolve_files(Command& command, const FormatDetails* details,
                   const ReferenceReader& read = read_reference);

}  // namespace winslow::io
