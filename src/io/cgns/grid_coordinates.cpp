#include "io/cgns/grid_coordinates.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace winslow::io::cgns {

NodeView find_grid(const NodeView& zone) {
  const auto grids = zone.children("GridCoordinates_t");
  const auto grid = std::find_if(grids.begin(), grids.end(), [](const NodeView& view) {
    return view.name() == "GridCoordinates";
  });
  if (grid == grids.end()) zone.fail("no GridCoordinates", "coordinates");
  if (const auto rind = grid->first("Rind_t")) {
    const auto planes = rind->integers();
    if (std::any_of(planes.begin(), planes.end(), [](std::int64_t n) { return n != 0; }))
      rind->fail("rind planes around the zone", "none");
  }
  return *grid;
}

std::optional<NodeView> coordinate_node(const NodeView& grid, std::size_t direction) {
  constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  return grid.child(names[direction]);
}

VertexPlaces read_places(const NodeView& grid, const ZoneHead& head) {
  VertexPlaces places;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto node = coordinate_node(grid, k);
    if (!node && k < (head.cell_dimension == 3 ? 3 : 2)) {
      std::string found;
      for (const NodeView& array : grid.children("DataArray_t"))
        found += (found.empty() ? "" : ", ") + array.name();
      grid.fail(found.empty() ? "no coordinates" : found,
                head.cell_dimension == 3 ? "CoordinateX, CoordinateY and CoordinateZ"
                                         : "CoordinateX and CoordinateY");
    }
    // A third coordinate counts in space only: the plane has none.
    if (!node || (k == 2 && head.physical_dimension == 2)) continue;
    places.of[k] = node->reals();
    if (static_cast<std::int64_t>(places.of[k].size()) != head.vertex_count) {
      node->fail(std::to_string(places.of[k].size()) + " values",
                 std::to_string(head.vertex_count) + ", one for each vertex");
    }
    const auto odd = std::find_if_not(places.of[k].begin(), places.of[k].end(),
                                      [](double value) { return std::isfinite(value); });
    if (odd != places.of[k].end()) {
      node->fail(
          "a value that is not finite for vertex " + std::to_string(odd - places.of[k].begin() + 1),
          "a finite number");
    }
  }
  return places;
}

}  // namespace winslow::io::cgns
