#pragma once

#include <set>

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// VTK files, legacy and XML: "VTK File Formats" (Kitware). VTK has no markers. winslow writes them
/// as line cells (triangles and quadrilaterals in volume meshes) with an integer cell array
/// "marker" (the marker's tag, 0 elsewhere). One field array "marker:NAME" per marker holds its
/// tag. Regions likewise: "region", "region:NAME".
namespace winslow::io::vtk {

/// Named cell types of VTK.
enum CellType : std::uint8_t {
  vertex = 1,
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
  pyramid = 14
};
/// The cell type of a marker's face.
CellType cell_type_of(const Face& face);
CellType cell_type_of(ElementType type);

using NamedTag = std::pair<std::string, int>;

/// The content of both file formats: a list of cells.
struct Grid {
  std::vector<double> points;  ///< x y z, node after node
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets{0};  ///< #cells + 1, into connectivity
  std::vector<std::int64_t> types;       ///< #cells
  std::vector<int> marker;               ///< #cells, or empty
  std::vector<int> region;               ///< #cells, or empty
  std::vector<NamedTag> marker_names;
  std::vector<NamedTag> region_names;
  std::set<std::string> dropped;  ///< names of arrays that are not kept

  std::vector<std::size_t> point_places;  ///< byte offset of each point in the file
  std::vector<std::size_t> cell_places;

  std::size_t cell_count() const { return types.size(); }
  void add_cell(CellType type, std::span<const Index> nodes, int marker_tag, int region_tag);
};

/// Details of a VTK file: its cells in the order of the file.
struct Details : BoundaryDetails {
  struct Item {
    enum class Kind : std::uint8_t { point, side, element } kind;
    Index index;  ///< into points, sides, or the elements of the mesh
  };
  std::vector<Item> items;
};

/// Collects the named arrays for the grid: those of winslow and those that Gmsh and meshio write.
class ArrayCollector {
 public:
  void cell_array(std::string_view name, const std::vector<double>& values, std::size_t components);
  void field_array(std::string_view name, const std::vector<double>& values);
  /// Moves the collected arrays into the grid, which must have its cells already.
  void finish(const Source& source, Grid& grid);

 private:
  std::vector<double> marker_;
  std::vector<double> region_;
  std::vector<double> physical_;
  std::vector<double> entity_;
  std::vector<NamedTag> marker_names_;
  std::vector<NamedTag> region_names_;
  std::set<std::string> dropped_;
};

/// Turns cells into a mesh. Throws InputError.
ParsedMesh to_mesh(const Source& source, const Grid& grid);
/// Cells of a mesh, in the order of its source if that is a VTK file and still fits.
Grid to_grid(const Mesh& mesh, const FormatDetails* source, std::vector<std::string>& warnings);

/// Legacy VTK files: unstructured grids and polygon data, versions 1 to 5, ASCII and binary. Writes
/// version 3.0, which every reader understands.
extern const MeshFormat legacy_format;
/// VTK XML unstructured grids (.vtu). Reads ASCII, inline base64, and appended raw or base64 data,
/// compressed by zlib or LZ4 or not. Writes ASCII or appended raw data.
extern const MeshFormat vtu_format;

}  // namespace winslow::io::vtk
