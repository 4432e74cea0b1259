#pragma once

#include "core/command/command.h"
#include "core/geometry/sliding_boundary.h"
#include "io/format/mesh_file.h"

/// What the slide options of a command ask of files: a reference surface, which they name, and the
/// periodic sides that the file of the mesh names. Core reads no files: this comes before
/// execute().
///
///     const winslow::io::MeshFile file = winslow::io::read_mesh("hull.msh");
///     winslow::SmoothCommand smooth;
///     smooth.smooth.slide.markers = {"hull"};
///     smooth.smooth.slide.reference = "cad.stl";
///     const auto ready = winslow::io::resolve_files(smooth, file.details.get());
///     state = winslow::execute(ready, winslow::make_state(file.mesh)).state;
namespace winslow::io {

/// Reads a surface mesh, or what bounds a volume mesh, of any format (read_mesh()) to slide on.
/// Throws InputError as read_mesh() does.
std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path);

/// Reads a reference surface, or has it from an earlier time.
using ReferenceReader =
    std::function<std::shared_ptr<const ReferenceSurface>(const std::filesystem::path&)>;

/// All that slide options ask of files. details: of MeshFile; null for a mesh that came from no
/// file. Throws what `read` throws.
SlideFiles resolve_files(const SlideOptions& slide, const FormatDetails* details,
                         const ReferenceReader& read = read_reference);
/// The same for a command; nothing for those that do not smooth. Throws UsageError, too, where
/// pairs of a mesh that came from no file are asked for. A file without pairs is for execute() to
/// refuse.
ResolvedCommand resolve_files(Command command, const FormatDetails* details,
                              const ReferenceReader& read = read_reference);

}  // namespace winslow::io
