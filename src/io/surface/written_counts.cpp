#include "io/surface/written_counts.h"

#include "io/surface/surface.h"

namespace winslow::io {

MeshCounts written_counts(const std::filesystem::path& path, const Mesh& mesh,
                          const FormatDetails* details) {
  const Topology& topology = *mesh.topology;
  const MeshFormat* format = format_of_extension(path);
  if (format == nullptr || format->keeps_markers) {
    return {topology.node_count(), topology.element_count(),
            topology.markers().from_file() ? topology.markers().size() : 0};
  }
  const surface::WrittenSurface surface(mesh, details);
  const bool triangles = format == &surface::stl_format;
  MeshCounts counts{surface.node_count(), 0, 0};
  for (const FileCorners& face : surface.faces())
    counts.elements += triangles && face.size() == 4 ? 2 : 1;
  return counts;
}

}  // namespace winslow::io
