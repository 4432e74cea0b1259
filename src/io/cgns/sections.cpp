#include <cstdlib>

#include "core/error.h"
#include "core/types.h"
#include "io/cgns/zones.h"
#include "io/format/cell_of_faces.h"
#include "io/format/foreign_formats.h"

/// The sections (Elements_t) of an unstructured zone.
namespace winslow::io::cgns {
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

/// A side and one of the two cells on it.
struct Parent {
  std::int64_t cell;
  std::size_t side;
  bool second;  ///< faces point from the first parent to the second
  const Section* section;
};

/// ParentElements: the first parents of all faces, then the second ones; 0: there is none.
void add_parents(const Section& section, std::size_t first_side, std::vector<Parent>& parents) {
  const NodeView view = required(section.view, "ParentElements");
  const auto values = view.integers();
  const auto count = static_cast<std::size_t>(section.count());
  if (values.size() != 2 * count) {
    view.fail(std::to_string(values.size()) + " numbers",
              "two for each of " + std::to_string(count) + " faces");
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] < 0) {
      const auto face = section.first + static_cast<std::int64_t>(k % count);
      view.fail("parent " + std::to_string(values[k]) + " of element " + std::to_string(face),
                "the number of a cell, or 0 for none");
    }
    if (values[k] > 0) parents.push_back({values[k], first_side + k % count, k >= count, &section});
  }
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
    if (section.type == ngon_n && dimension_ == 3 && section.view.child("ParentElements"))
      parented_.push_back({&section, first_side});
  }

  /// Reads the cells of a zone without NFACE_n: each is what lies on the sides of the faces that
  /// name it as a parent. Cells come in the order of their numbers, which are those of elements,
  /// or count cells alone. Call it after the sections were read, for a zone that has no cell in
  /// them.
  void read_cells_of_parents(const NodeView& zone, std::int64_t count,
                             const std::vector<Section>& sections) {
    std::vector<Parent> parents;
    for (const auto& [section, first_side] : parented_) add_parents(*section, first_side, parents);
    if (parents.empty()) return;
    std::ranges::stable_sort(parents, {}, &Parent::cell);
    for (auto begin = parents.begin(); begin != parents.end();) {
      const std::int64_t cell = begin->cell;
      if (begin != parents.begin() && cell != std::prev(begin)->cell + 1) {
        zone.fail("no face with the parent " + std::to_string(std::prev(begin)->cell + 1),
                  "cells numbered without a gap");
      }
      const auto end =
          std::find_if(begin, parents.end(), [&](const Parent& p) { return p.cell != cell; });
      add_cell_of({begin, end});
      begin = end;
    }
    if (mesh_.element_count() != count) {
      zone.fail(std::to_string(mesh_.element_count()) + " cells in ParentElements",
                std::to_string(count) + ", as the zone says");
    }
    // Where cells have numbers that sections have, too, these name the faces.
    const std::int64_t first = parents.front().cell, last = parents.back().cell;
    if (std::ranges::none_of(sections, [&](const Section& section) {
          return section.first <= last && first <= section.last;
        }))
      sides_.numbers.add({first, last, {{ElementPlace::Kind::cell, 0}}});
  }

  /// Sections of polygons list faces between cells, too. Such a section names no marker, and
  /// neither does the only one of a zone with one cell.
  void drop_inner_sections() {
    if (uses_.empty()) return;
    if (sides_.sections.size() == 1) return sides_.sections.clear();
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
    if (count < 3 || (dimension_ == 2 && count > 4)) {
      section_->view.fail(number(k) + " with " + std::to_string(count) + " corners",
                          dimension_ == 2 ? "triangles and quadrilaterals" : "three or more");
    }
    read_corners(k, static_cast<std::size_t>(count));
    if (dimension_ == 3) return add_side();
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
      if (!uses_.empty() && uses_[at(found.index)] == 2) {
        view_->fail(
            "face " + std::to_string(coded) + " in " + number(k) + ", which two cells have already",
            "at most two cells at a face");
      }
      faces.push_back(face_of_cell(at(found.index), face < 0));
    }
    places_.push_back({ElementPlace::Kind::cell, mesh_.element_count()});
    add_cell(std::move(faces), section_->view, number(k));
  }

  /// view, name: of the cell, for messages.
  void add_cell(std::vector<Face> faces, const NodeView& view, const std::string& name) {
    try {
      sides_.turned_cells += make_faces_alike(faces, 1) > 0 ? 1 : 0;
    } catch (const FacesFault& fault) {
      view.fail(fault.found + " in " + name + ", a polyhedron", fault.expected);
    }
    add_cell_of_faces(faces, mesh_);
  }

  /// A face as one of its cells sees it from outside; counts the cells of each face.
  Face face_of_cell(std::size_t side, bool reversed) {
    uses_.resize(sides_.faces.size(), 0);
    ++uses_[side];
    return reversed ? sides_.faces[side].reversed() : sides_.faces[side];
  }

  void add_cell_of(std::span<const Parent> parents) {
    std::vector<Face> faces;
    for (const Parent& parent : parents) faces.push_back(face_of_cell(parent.side, parent.second));
    add_cell(std::move(faces), required(parents.front().section->view, "ParentElements"),
             "cell " + std::to_string(parents.front().cell));
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
  std::vector<unsigned char> uses_;  // by cells that are made of faces, of each side
  std::vector<std::pair<const Section*, std::size_t>> parented_;  // and the first side of each
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
  if (mesh.types.empty()) reader.read_cells_of_parents(zone, head.cells, sections);
  reader.drop_inner_sections();
  if (mesh.types.empty()) zone.fail("no elements", wanted(head.cell_dimension));
  return sides;
}

}  // namespace winslow::io::cgns
