#pragma once

#include <array>
#include <optional>
#include <vector>

#include "io/cgns/zones.h"

namespace winslow::io::cgns {

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
