#pragma once

#include "io/format/mesh_file.h"

namespace winslow::io {

/// What is in a mesh file.
struct MeshCounts {
  Index nodes = 0, elements = 0;
  std::size_t markers = 0;
};

/// What write_mesh() puts into a file of that name: of a volume mesh in a surface format only the
/// boundary, of quadrilaterals in STL two triangles each, of markers that come from no file none.
///
///     const MeshCounts counts = written_counts("wing.stl", file.mesh, file.details.get());
MeshCounts written_counts(const std::filesystem::path& path, const Mesh& mesh,
                          const FormatDetails* details);

}  // namespace winslow::io
