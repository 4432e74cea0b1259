#pragma once

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"
#include "io/vtk/data_arrays.h"

/// VTK files, legacy and XML: "VTK File Formats" (Kitware). VTK has no markers. winslow writes them
/// as line cells (triangles and quadrilaterals in volume meshes) with an integer cell array
/// "marker" (the marker's tag, 0 elsewhere). One field array "marker:NAME" per marker holds its
/// tag. Regions likewise: "region", "region:NAME". Arrays that other programs write for the same
/// purpose are known as well (find_groups()). A mesh that goes back into a VTK file keeps cells and
/// arrays as they came.
namespace winslow::io::vtk {

/// Named cell types of VTK.
enum CellType : std::uint8_t {
  vertex = 1,
  poly_vertex = 2,
  line = 3,
  poly_line = 4,
  triangle = 5,
  polygon = 7,
  pixel = 8,
  quadrilateral = 9,
  tetrahedron = 10,
  voxel = 11,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  pentagonal_prism = 15,
  hexagonal_prism = 16,
  polyhedron = 42
};
/// The cell type of a marker's face.
CellType cell_type_of(const Face& face);
CellType cell_type_of(ElementType type);

using NamedTag = std::pair<std::string, int>;

/// The integer types of the list of cells of an XML file.
struct CellListTypes {
  ValueType connectivity{ValueKind::signed_integer, 8};
  ValueType offsets{ValueKind::signed_integer, 8};
  ValueType types{ValueKind::unsigned_integer, 1};
  ValueType faces{ValueKind::signed_integer, 8};
  ValueType face_offsets{ValueKind::signed_integer, 8};
};

/// The content of both file formats: a list of cells.
struct Grid {
  std::vector<double> points;  ///< x y z, node after node
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets{0};  ///< #cells + 1, into connectivity
  std::vector<std::int64_t> types;       ///< #cells
  /// The face streams of polyhedra: the number of faces, then of each the number of nodes and the
  /// nodes. face_offsets: #cells + 1, into faces; empty: there are no polyhedra.
  std::vector<std::int64_t> faces = {}, face_offsets = {};
  /// Faces as files of VTK 9.4 hold them, to be written again; empty: as face streams.
  std::vector<DataArray> face_tables = {};
  DataArrays data;
  CellListTypes list_types;
  std::string points_name = "Points";

  // Of a file that is read: what its arrays say about markers and regions.
  std::vector<int> marker;    ///< #cells, or empty; 0: none
  std::vector<int> region;    ///< #cells, or empty
  bool zero_is_none = true;   ///< 0 in `region` means no region
  std::string regions_array;  ///< name of the array that holds the regions; empty: none
  std::vector<NamedTag> marker_names;
  std::vector<NamedTag> region_names;

  std::vector<std::size_t> point_places;  ///< byte offset of each point in the file
  std::vector<std::size_t> cell_places;
  std::vector<std::size_t> face_places = {};  ///< of the faces of each cell; empty: cell_places

  std::size_t cell_count() const { return types.size(); }
  std::span<const std::int64_t> nodes(std::size_t cell) const {
    return row(connectivity, offsets, cell);
  }
  /// Empty for a cell that is no polyhedron.
  std::span<const std::int64_t> face_stream(std::size_t cell) const {
    return face_offsets.empty() ? std::span<const std::int64_t>() : row(faces, face_offsets, cell);
  }
  void add_cell(CellType type, std::span<const Index> nodes);
  void add_polyhedron(std::span<const Index> nodes, std::span<const Face> of_cell);

 private:
  static std::span<const std::int64_t> row(const std::vector<std::int64_t>& values,
                                           const std::vector<std::int64_t>& offsets,
                                           std::size_t k) {
    return {values.data() + offsets[k], static_cast<std::size_t>(offsets[k + 1] - offsets[k])};
  }
};

/// Details of a VTK file: its cells and arrays as they were read.
struct Details : BoundaryDetails {
  std::vector<Index> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<Index> faces, face_offsets;
  std::vector<DataArray> face_tables;
  CellListTypes list_types;
  std::string points_name;
  DataArrays data;
  std::vector<Region> markers, regions;  ///< names and tags

  std::string data_names() const override { return data.names(); }
  /// The nodes of a cell, ascending; of a polyhedron, those of its faces.
  std::vector<Index> nodes_of(std::size_t cell) const;
  /// As BoundaryDetails::fits(); also the nodes of all elements and all names are the same.
  bool fits(const Mesh& mesh) const;
};

/// Sets markers and regions of a grid, which must have its cells, from its arrays: "marker" and
/// "region", or the array of another name that holds whole numbers and is known to hold regions.
/// wanted: the name of the array that holds the regions; empty: a known one. Throws UsageError if
/// there is no such array, InputError if its values are no whole numbers.
void find_groups(const Source& source, Grid& grid, std::string_view wanted);

/// 0 to 3; that of elements for every type that is not known.
int dimension_of_cell(std::int64_t type);
/// The element type of a cell of dimension 2 or 3; none if the cell type is not supported.
std::optional<ElementType> element_of(std::int64_t type, std::size_t corners);

/// Turns cells into a mesh. Throws InputError.
ParsedMesh to_mesh(const Source& source, Grid grid);
/// Cells and arrays of a mesh: those of its source if that is a VTK file and still fits.
Grid to_grid(const Mesh& mesh, const FormatDetails* source, std::vector<std::string>& warnings);

/// Writes a legacy file of version 3.0; see MeshFormat::write.
std::vector<std::string> write_legacy(std::ostream& out, const Mesh& mesh,
                                      const FormatDetails* source, const WriteOptions& options);

/// Takes the faces of polyhedra out of the cells of a legacy file, of which each polyhedron lists
/// its face stream instead of its nodes. Throws InputError for a list that is none.
void split_face_streams(const Source& source, Grid& grid);

/// Legacy VTK files: unstructured grids and polygon data, versions 1 to 5, ASCII and binary. Writes
/// version 3.0, which every reader understands.
extern const MeshFormat legacy_format;
/// VTK XML unstructured grids (.vtu). Reads ASCII, inline base64, and appended raw or base64 data,
/// compressed by zlib or LZ4 or not. Writes ASCII or appended raw data.
extern const MeshFormat vtu_format;

}  // namespace winslow::io::vtk
