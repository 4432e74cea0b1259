#include "io/cgns/zones.h"

#include <cstdlib>

#include "core/error.h"
#include "core/types.h"
#include "io/format/cell_of_faces.h"
#include "io/format/foreign_formats.h"

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

namespace {

const char* wanted(int cell_dimension) {
  constexpr std::array wanted{
      "", "", "BAR_2, TRI_3, QUAD_4, MIXED or NGON_n of them",
      "TETRA_4, PYRA_5, PENTA_6, HEXA_8 and TRI_3 and QUAD_4 around them, MIXED, or NFACE_n of "
      "NGON_n"};
  return wanted[at(cell_dimension)];
}

struct Section {
  NodeView view;
  std::int64_t type, first, last;

  std::int64_t count() const { return last - first + 1; }
};

NodeView required(const NodeView& parent, std::string_view name) {
  auto child = parent.child(name);
  if (!child) parent.fail("no " + std::string(name), "one");
  return *child;
}

Section open_section(const NodeView& view) {
  const auto data = view.integers();
  if (data.empty()) view.fail("no element type", "one");
  const NodeView range_view = required(view, "ElementRange");
  const auto range = range_view.integers();
  if (range.size() != 2 || range[0] < 1 || range[1] < range[0] - 1 ||
      range[1] > std::numeric_limits<Index>::max()) {
    range_view.fail(range.size() == 2
                        ? "elements " + std::to_string(range[0]) + " to " + std::to_string(range[1])
                        : std::to_string(range.size()) + " numbers",
                    "the numbers of the first and the last element");
  }
  return {view, data[0], range[0], range[1]};
}

/// Reads the elements of the sections in turn.
class SectionReader {
 public:
  SectionReader(const ZoneHead& head, MeshData& mesh, ZoneSides& sides)
      : vertices_(head.vertex_count), dimension_(head.cell_dimension), mesh_(mesh), sides_(sides) {}

  void read(const Section& section) {
    section_ = &section;
    at_ = 0;
    places_.clear();
    const std::size_t first_side = sides_.faces.size();
    faces_of_cells_ = section.type == nface_n && dimension_ == 3;
    if (section.type == node_element) {
      for (std::int64_t k = 0; k < section.count(); ++k) add_point();
    } else {
      const NodeView view = required(section.view, "ElementConnectivity");
      view_ = &view;
      connectivity_ = view.integers();
      // The offsets are needed only for NGON_n and NFACE_n written by CGNS 4, whose connectivity
      // holds nothing but the corners or faces. In MIXED and older ones it is sufficient.
      starts_ = section.type == ngon_n || section.type == nface_n ? read_starts()
                                                                  : std::vector<std::int64_t>();
      for (std::int64_t k = 0; k < section.count(); ++k) read_element(k);
      if (at_ != connectivity_.size()) {
        view.fail(std::to_string(connectivity_.size()) + " numbers",
                  std::to_string(at_) + " for " + std::to_string(section.count()) + " elements");
      }
      view_ = nullptr;
    }
    if (sides_.faces.size() > first_side) {
      sides_.sections.push_back(
          {section.view.name(), first_side, sides_.faces.size() - first_side});
    }
    sides_.numbers.add({section.first, section.last, std::move(places_)});
  }

  /// Sections of polygons list faces between cells, too. Such a section names no marker.
  void drop_inner_sections() {
    if (uses_.empty()) return;
    uses_.resize(sides_.faces.size(), 0);
    std::erase_if(sides_.sections, [&](const ZoneSides::Section& section) {
      const auto begin = uses_.begin() + static_cast<std::ptrdiff_t>(section.first);
      return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(section.count),
                         [](unsigned char uses) { return uses != 1; });
    });
  }

 private:
  std::vector<std::int64_t> read_starts() const {
    const auto view = section_->view.child("ElementStartOffset");
    if (!view) return {};
    auto starts = view->integers();
    if (starts.size() != static_cast<std::size_t>(section_->count()) + 1 || starts[0] != 0) {
      view->fail(std::to_string(starts.size()) + " offsets",
                 std::to_string(section_->count() + 1) + ", the first of them 0");
    }
    return starts;
  }

  std::string number(std::int64_t k) const {
    return "element " + std::to_string(section_->first + k);
  }

  std::int64_t next_number(std::int64_t k) {
    if (at_ >= connectivity_.size()) view_->fail("the end", number(k));
    return connectivity_[at_++];
  }

  void read_element(std::int64_t k) {
    std::int64_t type = section_->type;
    if (type == mixed) type = next_number(k);
    if (type == node_element) {
      next_number(k);
      return add_point();
    }
    if (type == ngon_n) return read_polygon(k);
    if (faces_of_cells_) return read_cell(k);
    if (type == bar_2) return read_line(k);
    const auto element = element_of(type);
    if (!element || dimension_of(*element) > dimension_) refuse(k, type);
    read_corners(k, static_cast<std::size_t>(corner_count(*element)));
    add(*element);
  }

  void read_line(std::int64_t k) {
    read_corners(k, 2);
    if (dimension_ == 2) return add_side();
    places_.push_back({ElementPlace::Kind::line, static_cast<Index>(places_.size())});
  }

  void read_polygon(std::int64_t k) {
    const auto place = static_cast<std::size_t>(k);
    const std::int64_t count =
        starts_.empty() ? next_number(k) : starts_[place + 1] - starts_[place];
    if (count != 3 && count != 4) {
      section_->view.fail(number(k) + " with " + std::to_string(count) + " corners",
                          "triangles and quadrilaterals");
    }
    read_corners(k, static_cast<std::size_t>(count));
    add(count == 3 ? ElementType::triangle : ElementType::quadrilateral);
  }

  /// A cell of NFACE_n: the numbers of its faces, negative for those seen from inside.
  void read_cell(std::int64_t k) {
    const auto place = static_cast<std::size_t>(k);
    const std::int64_t count =
        starts_.empty() ? next_number(k) : starts_[place + 1] - starts_[place];
    std::vector<Face> faces;
    for (std::int64_t f = 0; f < count; ++f) {
      const std::int64_t coded = next_number(k);
      const std::int64_t face = coded == std::numeric_limits<std::int64_t>::min() ? 0 : coded;
      const ElementPlace found = sides_.numbers.find(std::abs(face));
      if (found.kind != ElementPlace::Kind::side) {
        view_->fail("face " + std::to_string(coded) + " in " + number(k),
                    "the number of a face in a section NGON_n");
      }
      faces.push_back(face < 0 ? sides_.faces[at(found.index)].reversed()
                               : sides_.faces[at(found.index)]);
      uses_.resize(sides_.faces.size(), 0);
      ++uses_[at(found.index)];
    }
    const auto cell = cell_of_faces(faces);
    if (!cell) {
      section_->view.fail(number(k) + ", a polyhedron of " + std::to_string(count) + " faces",
                          "tetrahedra, pyramids, prisms and hexahedra");
    }
    places_.push_back({ElementPlace::Kind::cell, mesh_.element_count()});
    mesh_.add_element(cell->type, cell->corners);
  }

  [[noreturn]] void refuse(std::int64_t k, std::int64_t type) const {
    const std::string where = section_->type == mixed ? " for " + number(k) : "";
    const std::string hint = element_hint(type, dimension_);
    section_->view.fail(element_name(type) + where + hint,
                        wanted(dimension_) + (hint.find("order") == std::string::npos
                                                  ? std::string()
                                                  : first_order_hint(section_->view.file())));
  }

  void read_corners(std::int64_t k, std::size_t count) {
    corners_.clear();
    for (std::size_t c = 0; c < count; ++c) {
      const std::int64_t vertex = next_number(k);
      if (vertex < 1 || vertex > vertices_) {
        view_->fail("vertex " + std::to_string(vertex) + " in " + number(k),
                    "1 to " + std::to_string(vertices_));
      }
      corners_.push_back(static_cast<Index>(vertex - 1));
    }
  }

  void add(ElementType type) {
    if (dimension_of(type) < dimension_) return add_side();
    places_.push_back({ElementPlace::Kind::cell, mesh_.element_count()});
    mesh_.add_element(type, corners_);
  }

  void add_side() {
    places_.push_back({ElementPlace::Kind::side, static_cast<Index>(sides_.faces.size())});
    sides_.faces.emplace_back(corners_);
  }

  void add_point() {
    places_.push_back({ElementPlace::Kind::point, static_cast<Index>(places_.size())});
  }

  std::int64_t vertices_;
  int dimension_;  // of the cells
  MeshData& mesh_;
  ZoneSides& sides_;
  const Section* section_ = nullptr;
  const NodeView* view_ = nullptr;
  std::vector<std::int64_t> connectivity_, starts_;
  std::size_t at_ = 0;
  std::vector<Index> corners_;
  std::vector<ElementPlace> places_;
  bool faces_of_cells_ = false;      // the section is NFACE_n
  std::vector<unsigned char> uses_;  // by cells of NFACE_n, of each side
};

}  // namespace

ElementPlace ElementNumbers::find(std::int64_t number) const {
  const auto after =
      std::upper_bound(ranges_.begin(), ranges_.end(), number,
                       [](std::int64_t n, const Range& range) { return n < range.first; });
  if (after == ranges_.begin() || number > std::prev(after)->last) return {};
  const Range& range = *std::prev(after);
  const std::int64_t k = number - range.first;
  if (range.places.size() > 1) return range.places[static_cast<std::size_t>(k)];
  const ElementPlace& first = range.places.front();
  return {first.kind, first.index + static_cast<Index>(k)};
}

void ElementNumbers::add(Range range) {
  const auto breaks = [](const ElementPlace& a, const ElementPlace& b) {
    return a.kind != b.kind || a.index + 1 != b.index;
  };
  const bool even =
      std::adjacent_find(range.places.begin(), range.places.end(), breaks) == range.places.end();
  if (even) range.places.resize(1);
  range.places.shrink_to_fit();
  const auto after =
      std::upper_bound(ranges_.begin(), ranges_.end(), range.first,
                       [](std::int64_t first, const Range& other) { return first < other.first; });
  ranges_.insert(after, std::move(range));
}

ZoneSides read_sections(const NodeView& zone, const ZoneHead& head, MeshData& mesh) {
  std::vector<Section> sections;
  for (const NodeView& view : zone.children("Elements_t")) {
    Section section = open_section(view);
    if (section.count() > 0) sections.push_back(std::move(section));
  }
  std::stable_sort(sections.begin(), sections.end(),
                   [](const Section& a, const Section& b) { return a.first < b.first; });
  ZoneSides sides;
  SectionReader reader(head, mesh, sides);
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (s > 0 && sections[s].first <= sections[s - 1].last) {
      sections[s].view.fail("element " + std::to_string(sections[s].first) + ", which section " +
                                in_quotes(sections[s - 1].view.name()) + " has, too",
                            "numbers of its own");
    }
  }
  // Cells of faces need their faces, wherever these stand.
  std::stable_partition(sections.begin(), sections.end(),
                        [](const Section& section) { return section.type != nface_n; });
  for (const Section& section : sections) reader.read(section);
  reader.drop_inner_sections();
  if (mesh.types.empty()) zone.fail("no elements", wanted(head.cell_dimension));
  return sides;
}

}  // namespace winslow::io::cgns
