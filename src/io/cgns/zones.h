#pragma once

#include "core/mesh/element_type.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/tree.h"

namespace winslow::io::cgns {

/// A zone and the base that it belongs to.
struct ZonePlace {
  NodeView base, zone;
};

/// All zones of a file; users call the N-th of them zone N. Bases are in the order of the file, the
/// zones of a base sorted by name, as libcgns counts them. Throws InputError if there is none.
std::vector<ZonePlace> find_zones(const NodeView& root);

/// Place of a zone in the list; 0: the first. Throws UsageError if there is none of that number.
std::size_t choose_zone(const std::vector<ZonePlace>& zones, int number);

/// Sizes and type of a zone (Zone_t, ZoneType_t).
struct ZoneHead {
  int cell_dimension = 2;      ///< of the base
  int physical_dimension = 2;  ///< of the base
  bool structured = false;
  std::vector<std::int64_t> vertices;  ///< in each index direction; one number, if unstructured
  std::int64_t cells = 0;
  std::int64_t vertex_count = 0;
};

/// Throws InputError for impossible sizes.
ZoneHead read_head(const ZonePlace& place);

/// The grid that winslow reads from a zone: the node called GridCoordinates. Throws InputError if
/// there is none, or if it has rind planes.
NodeView find_grid(const NodeView& zone);

/// The node CoordinateX (0), CoordinateY (1) or CoordinateZ (2) of a grid, if it exists.
std::optional<NodeView> coordinate_node(const NodeView& grid, std::size_t direction);

/// x, y, z of every vertex; z is empty where the file has none.
struct VertexPlaces {
  std::array<std::vector<double>, 3> of;
};
/// Reads the coordinates. Throws InputError for missing ones, other types than real numbers, a
/// number other than that of the vertices, and values that are not finite.
VertexPlaces read_places(const NodeView& grid, const ZoneHead& head);

/// Numbers of the element types that readers and writers treat apart (ElementType_t of the SIDS).
enum : std::int64_t { node_element = 2, bar_2 = 3, mixed = 20, ngon_n = 22, nface_n = 23 };

/// The name of an element type: "QUAD_4"; "type 99" for an undefined number.
std::string element_name(std::int64_t type);
/// Our element type for one of CGNS (TRI_3, ..., HEXA_8); nothing for other types.
std::optional<ElementType> element_of(std::int64_t type);
std::int64_t element_number(ElementType type);
/// Why a mesh of that cell dimension cannot hold a type: " (second or higher order)" and the like;
/// may be empty.
std::string element_hint(std::int64_t type, int cell_dimension);

/// What an element of a zone is, by its number.
struct ElementPlace {
  enum class Kind : std::uint8_t { none, point, line, side, cell };
  Kind kind = Kind::none;  ///< none: the zone has no element of that number
  /// Index of a side among the sides of the zone, or of a cell among the elements of the mesh.
  Index index = -1;
};

/// What the elements of an unstructured zone are.
class ElementNumbers {
 public:
  ElementPlace find(std::int64_t number) const;
  std::int64_t last() const { return ranges_.empty() ? 0 : ranges_.back().last; }

  struct Range {
    std::int64_t first, last;
    std::vector<ElementPlace> places;  ///< of each number; one alone: of the first, then
                                       ///< consecutive
  };
  /// Ranges may be added in any order. Consecutive places are stored as one.
  void add(Range range);

 private:
  std::vector<Range> ranges_;
};

/// The elements of one dimension less than the cells: lines, or triangles, quadrilaterals and
/// polygons. Markers are made of them.
struct ZoneSides {
  struct Section {
    std::string name;
    std::size_t first, count;  ///< of its sides in `faces`
  };
  std::vector<Face> faces;
  std::vector<Section> sections;
  ElementNumbers numbers;
  Index turned_cells = 0;  ///< cells given by faces of which some faced the other way
};

/// Reads all sections (Elements_t), in the order of their element numbers: cells into the mesh,
/// sides into the result. Where no section holds cells, the ParentElements of NGON_n give them.
/// Skips elements of lower dimension. Throws InputError with the names of unsupported element
/// types.
ZoneSides read_sections(const NodeView& zone, const ZoneHead& head, MeshData& mesh);

}  // namespace winslow::io::cgns
