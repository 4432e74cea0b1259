#pragma once

#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// AFLR3 grids (.ugrid): "UG_IO 3D Grid File Type UGRID", SimCenter, Mississippi State University;
/// and FUN3D's .mapbc file beside the grid: names and boundary conditions of surfaces.
namespace winslow::io::ugrid {

/// Encoding of a file, by its last but one extension: none (text), or, in this order, "l" for
/// little-endian, "b" for plain bytes or "r" for records of Fortran, "8" or "4" for the bytes of a
/// coordinate, "l" for integers of 64 bits: .b8, .lb8, .b4, .lb4, .r8, .lr8, .b8l, .lb8l, ...
struct Encoding {
  bool binary = false;
  bool big_endian = false;
  bool single = false;   ///< coordinates of 4 bytes
  bool records = false;  ///< two records of Fortran, unformatted: the counts, and all the rest
  bool wide = false;     ///< integers of 64 bits

  std::size_t integer_bytes() const { return wide ? 8 : 4; }
  std::size_t real_bytes() const { return single ? 4 : 8; }

  bool operator==(const Encoding&) const = default;
};
/// The encoding by name; nothing for an unknown last but one extension, as in "mesh.xyz.ugrid".
std::optional<Encoding> encoding_of_name(const std::filesystem::path& path);
/// The binary encoding for which the counts at the start of the content fit its size; text if the
/// first line holds the counts.
std::optional<Encoding> encoding_of_content(std::string_view content);

/// The content of a record of a file that Fortran wrote unformatted: a range of bytes. The length
/// of the record stands before and behind it, in four bytes each.
struct Record {
  std::size_t begin, end;
};
/// All records of a file; nothing if the lengths do not fit the content. Negative lengths mark
/// parts of records of more than 2 GiB.
std::vector<Record> find_records(std::string_view content, bool big_endian);

/// The counts of a file, in the order of its first line.
struct Counts {
  std::int64_t nodes = 0, triangles = 0, quadrilaterals = 0;
  std::array<std::int64_t, 4> elements{};  ///< in the order of element_order
};
/// Bytes of a binary file with these counts, without lengths of records; 0 for impossible counts.
std::uint64_t content_size(const std::array<std::int64_t, 7>& counts, const Encoding& encoding);
constexpr std::array<ElementType, 4> element_order{ElementType::tetrahedron, ElementType::pyramid,
                                                   ElementType::prism, ElementType::hexahedron};

/// "mesh.mapbc" for "mesh.b8.ugrid" and for "mesh.ugrid.gz".
std::filesystem::path mapbc_path(const std::filesystem::path& path);

/// A line of a .mapbc file.
struct Surface {
  int tag = 0;
  int boundary_condition = 0;
  std::string name;       ///< without the quotes around it
  std::string line = {};  ///< as it was read, without its end; empty: of no file
};

/// The content of a .mapbc file.
struct Mapbc {
  std::vector<Surface> surfaces;
  std::string text = {};  ///< the whole file as it was read; empty: there is none
};

struct Details : BoundaryDetails {
  Encoding encoding;
  Mapbc mapbc;
  std::vector<int> tags;  ///< number of the surface of each side; several may be one marker
};

extern const MeshFormat format;

ParsedMesh read(Source& source);
std::vector<OutputFile> files(const std::filesystem::path& path, const Mesh& mesh,
                              const FormatDetails* details, const WriteOptions& options,
                              std::vector<std::string>& warnings);

/// Appends a .mapbc file to the source and reads it, if it exists: the number of surfaces, then a
/// line with number, boundary condition (of FUN3D) and name for each. A name goes to the end of the
/// line or to '!', where a comment begins; quotes around it are no part of it. Throws InputError.
Mapbc read_mapbc(Source& source, const std::filesystem::path& path);

/// A name as a .mapbc file can hold it: in one line, without '!', in quotes if it would not be read
/// as itself.
std::string mapbc_name(const std::string& name);
/// Writes lines that were read as they were.
void write_mapbc(std::ostream& out, const std::vector<Surface>& surfaces);

}  // namespace winslow::io::ugrid
