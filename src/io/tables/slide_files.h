#pragma once

#include "core/command/command.h"
#include "core/geometry/sliding_boundary.h"
#include "io/format/mesh_file.h"

/// Reads the files that the slide options of a command need: the reference surface that they name,
/// and the periodic sides of the mesh file. Core reads no files, so call this before execute().
///
///     const winslow::io::MeshFile file = winslow::io::read_mesh("hull.msh");
///     winslow::SmoothCommand smooth;
///     smooth.smooth.slide.markers = {"hull"};
///     smooth.smooth.slide.reference = "cad.stl";
///     const auto ready = winslow::io::resolve_files(smooth, file.details.get());
///     state = winslow::execute(ready, winslow::make_state(file.mesh)).state;
namespace winslow::io {

/// Reads a surface mesh, or the boundary of a volume mesh, of any format (read_mesh()) to slide on.
/// Throws InputError as read_mesh() does.
std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path);

/// Reads a reference surface or takes it from a cache.
using ReferenceReader =
    std::function<std::shared_ptr<const ReferenceSurface>(const std::filesystem::path&)>;

/// Reads everything that slide options need from files. details: of MeshFile; null for a mesh that
/// came from no file. Throws what `read` throws.
SlideFiles resolve_files(const SlideOptions& slide, const FormatDetails* details,
                         const ReferenceReader& read = read_reference);
/// The same for a command; commands that do not smooth need no files. Also throws UsageError if the
/// command needs the pairs of a mesh that came from no file. A file without pairs is no error here;
/// execute() rejects it.
ResolvedCommand resolve_files(Command command, const FormatDetails* details,
                              const ReferenceReader& read = read_reference);

}  // namespace winslow::io
