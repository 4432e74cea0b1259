#include "io/cgns/zones.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/types.h"

namespace winslow::io::cgns {

std::vector<ZonePlace> find_zones(const NodeView& root) {
  std::vector<ZonePlace> places;
  const auto bases = root.children("CGNSBase_t");
  if (bases.empty()) root.fail("no CGNSBase_t node", "a CGNS file, which has one");
  for (const NodeView& base : bases) {
    auto zones = base.children("Zone_t");
    std::stable_sort(zones.begin(), zones.end(),
                     [](const NodeView& a, const NodeView& b) { return a.name() < b.name(); });
    for (NodeView& zone : zones) places.push_back({base, std::move(zone)});
  }
  if (places.empty()) root.fail("no Zone_t node in any base", "a mesh");
  return places;
}

std::size_t choose_zone(const std::vector<ZonePlace>& zones, int number) {
  if (number == 0) return 0;
  if (number > 0 && static_cast<std::size_t>(number) <= zones.size())
    return static_cast<std::size_t>(number) - 1;
  throw UsageError(zones.front().zone.file() + ": no zone " + std::to_string(number) +
                   " in the file, expected 1 to " + std::to_string(zones.size()));
}

ZoneHead read_head(const ZonePlace& place) {
  const auto [base, zone] = place;
  const auto dimensions = base.integers();
  if (dimensions.size() != 2) {
    base.fail(std::to_string(dimensions.size()) + " numbers",
              "CellDimension and PhysicalDimension");
  }
  if (dimensions[0] != 2 && dimensions[0] != 3)
    base.fail("CellDimension " + std::to_string(dimensions[0]), "2 or 3");
  if (dimensions[1] != 3 && dimensions[1] != dimensions[0]) {
    base.fail("PhysicalDimension " + std::to_string(dimensions[1]),
              dimensions[0] == 2 ? "2 or 3" : "3");
  }
  ZoneHead head;
  head.cell_dimension = static_cast<int>(dimensions[0]);
  head.physical_dimension = static_cast<int>(dimensions[1]);
  const auto type = zone.first("ZoneType_t");
  const std::string kind = type ? type->text() : "Structured";  // what the SIDS take it for
  if (kind != "Structured" && kind != "Unstructured")
    type->fail(in_quotes(kind), "Structured or Unstructured");
  head.structured = kind == "Structured";
  if (head.structured && head.cell_dimension == 3)
    zone.fail("a structured zone of three dimensions", "an unstructured one");
  const auto sizes = zone.integers();
  const std::size_t indices = head.structured ? static_cast<std::size_t>(head.cell_dimension) : 1;
  if (sizes.size() != 3 * indices) {
    zone.fail(std::to_string(sizes.size()) + " sizes",
              std::to_string(3 * indices) + " of " + (head.structured ? "a" : "an un") +
                  (head.structured ? " structured zone" : "structured zone"));
  }
  const std::int64_t least = head.structured ? 2 : 3;
  head.vertex_count = head.cells = 1;
  for (std::size_t k = 0; k < indices; ++k) {
    if (sizes[k] < least || sizes[k] > std::numeric_limits<Index>::max()) {
      zone.fail(std::to_string(sizes[k]) + " vertices",
                "at least " + std::to_string(least) + ", and no more than can be numbered");
    }
    head.vertices.push_back(sizes[k]);
    head.vertex_count *= sizes[k];
    head.cells *= head.structured ? sizes[k] - 1 : sizes[indices + k];
  }
  if (head.vertex_count > std::numeric_limits<Index>::max())
    zone.fail(std::to_string(head.vertex_count) + " vertices", "no more than can be numbered");
  return head;
}

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
