#pragma once

#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// AFLR3 grids (.ugrid): "UG_IO 3D Grid File Type UGRID", SimCenter, Mississippi State University;
/// and the .mapbc file beside one, which FUN3D reads: names and boundary conditions of surfaces.
namespace winslow::io::ugrid {

/// How a file is encoded, as the last but one extension says: none, .b8, .lb8, .b4, .lb4.
struct Encoding {
  bool binary = false;
  bool big_endian = false;
  bool single = false;  ///< coordinates of 4 bytes

  bool operator==(const Encoding&) const = default;
};
/// Nothing for "mesh.xyz.ugrid", whose last but one extension means nothing.
std::optional<Encoding> encoding_of_name(const std::filesystem::path& path);
/// The binary encoding by which the counts at the start of the content fit its size, or text, if
/// its first line holds the counts.
std::optional<Encoding> encoding_of_content(std::string_view content);

/// Numbers of the things in a file, in the order of its first line.
struct Counts {
  std::int64_t nodes = 0, triangles = 0, quadrilaterals = 0;
  std::array<std::int64_t, 4> elements{};  ///< in the order of element_order
};
constexpr std::array<ElementType, 4> element_order{ElementType::tetrahedron, ElementType::pyramid,
                                                   ElementType::prism, ElementType::hexahedron};

/// "mesh.mapbc" of "mesh.b8.ugrid" and of "mesh.ugrid.gz".
std::filesystem::path mapbc_path(const std::filesystem::path& path);

/// A line of a .mapbc file.
struct Surface {
  int tag = 0;
  int boundary_condition = 0;
  std::string name;
};

struct Details : BoundaryDetails {
  Encoding encoding;
  std::vector<Surface> surfaces;  ///< of the .mapbc file
};

extern const MeshFormat format;

ParsedMesh read(Source& source);
std::vector<OutputFile> files(const std::filesystem::path& path, const Mesh& mesh,
                              const FormatDetails* details, const WriteOptions& options,
                              std::vector<std::string>& warnings);

/// Reads a .mapbc file, appended to the source, if there is one: the number of surfaces; then for
/// each, in a line, its number, its boundary condition (of FUN3D) and its name. Throws InputError.
std::vector<Surface> read_mapbc(Source& source, const std::filesystem::path& path);

void write_mapbc(std::ostream& out, const std::vector<Surface>& surfaces);

}  // namespace winslow::io::ugrid
