#include "io/cgns/zones.h"

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
  const std::string kind = type ? type->text() : "Structured";  // default of the SIDS
  if (kind != "Structured" && kind != "Unstructured")
    type->fail(in_quotes(kind), "Structured or Unstructured");
  head.structured = kind == "Structured";
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
    if (head.vertex_count > std::numeric_limits<Index>::max())
      zone.fail(std::to_string(head.vertex_count) + " vertices", "no more than can be numbered");
    head.cells *= head.structured ? sizes[k] - 1 : sizes[indices + k];
  }
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
  constexpr std::array wanted{"", "", "CoordinateX and CoordinateY",
                              "CoordinateX, CoordinateY and CoordinateZ"};
  // A third coordinate counts only in space; a base in the plane has none.
  for (std::size_t k = 0; k < at(head.physical_dimension); ++k) {
    const auto node = coordinate_node(grid, k);
    if (!node && k < at(head.cell_dimension)) {
      const std::string found =
          list_of(grid.children("DataArray_t"), [](const NodeView& array) { return array.name(); });
      grid.fail(found.empty() ? "no coordinates" : found, wanted[at(head.cell_dimension)]);
    }
    if (!node) continue;
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

namespace {

/// In the order of ElementType_t.
constexpr std::array<std::string_view, 57> names{"ElementTypeNull",
                                                 "ElementTypeUserDefined",
                                                 "NODE",
                                                 "BAR_2",
                                                 "BAR_3",
                                                 "TRI_3",
                                                 "TRI_6",
                                                 "QUAD_4",
                                                 "QUAD_8",
                                                 "QUAD_9",
                                                 "TETRA_4",
                                                 "TETRA_10",
                                                 "PYRA_5",
                                                 "PYRA_14",
                                                 "PENTA_6",
                                                 "PENTA_15",
                                                 "PENTA_18",
                                                 "HEXA_8",
                                                 "HEXA_20",
                                                 "HEXA_27",
                                                 "MIXED",
                                                 "PYRA_13",
                                                 "NGON_n",
                                                 "NFACE_n",
                                                 "BAR_4",
                                                 "TRI_9",
                                                 "TRI_10",
                                                 "QUAD_12",
                                                 "QUAD_16",
                                                 "TETRA_16",
                                                 "TETRA_20",
                                                 "PYRA_21",
                                                 "PYRA_29",
                                                 "PYRA_30",
                                                 "PENTA_24",
                                                 "PENTA_38",
                                                 "PENTA_40",
                                                 "HEXA_32",
                                                 "HEXA_56",
                                                 "HEXA_64",
                                                 "BAR_5",
                                                 "TRI_12",
                                                 "TRI_15",
                                                 "QUAD_P4_16",
                                                 "QUAD_25",
                                                 "TETRA_22",
                                                 "TETRA_34",
                                                 "TETRA_35",
                                                 "PYRA_P4_29",
                                                 "PYRA_50",
                                                 "PYRA_55",
                                                 "PENTA_33",
                                                 "PENTA_66",
                                                 "PENTA_75",
                                                 "HEXA_44",
                                                 "HEXA_98",
                                                 "HEXA_125"};

/// CGNS and winslow number the corners in the same way (core/mesh/element_type.h).
constexpr std::array<std::pair<std::int64_t, ElementType>, 6> ours{{{5, ElementType::triangle},
                                                                    {7, ElementType::quadrilateral},
                                                                    {10, ElementType::tetrahedron},
                                                                    {12, ElementType::pyramid},
                                                                    {14, ElementType::prism},
                                                                    {17, ElementType::hexahedron}}};

}  // namespace

std::string element_name(std::int64_t type) {
  if (type < 0 || type >= static_cast<std::int64_t>(names.size()))
    return "type " + std::to_string(type);
  return std::string(names[static_cast<std::size_t>(type)]);
}

std::optional<ElementType> element_of(std::int64_t type) {
  for (const auto& [number, element] : ours)
    if (number == type) return element;
  return std::nullopt;
}

std::int64_t element_number(ElementType type) {
  const auto* found = std::find_if(ours.begin(), ours.end(),
                                   [&](const auto& entry) { return entry.second == type; });
  return found->first;
}

std::string element_hint(std::int64_t type, int cell_dimension) {
  const auto element = element_of(type);
  const int dimension = type == nface_n ? 3 : element ? dimension_of(*element) : 0;
  if (dimension > cell_dimension) return " (a 3D mesh)";
  const bool known = type > node_element && type < static_cast<std::int64_t>(names.size());
  return known && !element && type != bar_2 && type != mixed && type != ngon_n
             ? " (second or higher order)"
             : "";
}

}  // namespace winslow::io::cgns
