#pragma once

#include <array>

#include "io/cgns/tree.h"

namespace winslow::io::cgns {

/// A zone and the base that it belongs to.
struct ZonePlace {
  NodeView base, zone;
};

/// All zones of a file; zone N of the program is the N-th of them. Bases come in the order of the
/// file, the zones of each by name, as libcgns counts them for every program that uses it. Throws
/// InputError if there is none.
std::vector<ZonePlace> find_zones(const NodeView& root);

/// Place of a zone in the list; 0: the first. Throws UsageError if there is none of that number.
std::size_t choose_zone(const std::vector<ZonePlace>& zones, int number);

/// What a zone says of itself (Zone_t, ZoneType_t).
struct ZoneHead {
  int cell_dimension = 2;      ///< of the base
  int physical_dimension = 2;  ///< of the base
  bool structured = false;
  std::vector<std::int64_t> vertices;  ///< in each index direction; one number, if unstructured
  std::int64_t cells = 0;
  std::int64_t vertex_count = 0;
};

/// Throws InputError for a structured zone of three dimensions and for numbers that make no sense.
ZoneHead read_head(const ZonePlace& place);

/// The grid of a zone that winslow works on: the node called GridCoordinates. Throws InputError if
/// there is none, or if it has rind planes.
NodeView find_grid(const NodeView& zone);

/// The node CoordinateX (0), CoordinateY (1) or CoordinateZ (2) of a grid, if it has it.
std::optional<NodeView> coordinate_node(const NodeView& grid, std::size_t direction);

/// x, y, z of every vertex; z is empty where the file has none.
struct VertexPlaces {
  std::array<std::vector<double>, 3> of;
};
/// Throws InputError: coordinates of another kind, of another number than there are vertices, or
/// not finite.
VertexPlaces read_places(const NodeView& grid, const ZoneHead& head);

}  // namespace winslow::io::cgns
