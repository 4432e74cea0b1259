#include "io/cgns/face_sections.h"

#include "io/cgns/zones.h"
#include "io/format/cell_of_faces.h"

namespace winslow::io::cgns {
namespace {

using Integers = std::vector<std::int32_t>;

/// Collects the entries of elements of any size.
class PolySection {
 public:
  explicit PolySection(bool start_offsets) : start_offsets_(start_offsets) {
    if (start_offsets) starts_.push_back(0);
  }

  void begin(std::size_t size) {
    if (!start_offsets_) entries_.push_back(static_cast<std::int32_t>(size));
  }
  void add(Index entry) { entries_.push_back(entry); }
  void end() {
    const Index size = index_count(entries_.size(), "numbers in a section of a CGNS file");
    if (start_offsets_) starts_.push_back(size);
    ++count_;
  }

  std::shared_ptr<Node> node(const char* name, std::int64_t type, Index first) const {
    return make_section(name, type, first, count_, entries_, starts_);
  }

 private:
  bool start_offsets_;
  Integers entries_, starts_;
  Index count_ = 0;
};

/// Numbers the faces of a mesh from 1 on, and lists them in that order.
class FaceOrder {
 public:
  explicit FaceOrder(const Topology& topology)
      : topology_(topology), numbers_(at(topology.face_count()), 0) {}

  /// The number of a face of a marker. The first marker decides where its nodes begin.
  std::int32_t number_of(const Face& face) {
    const Index f = *topology_.find_face(face);
    if (numbers_[at(f)] == 0) {
      const Face outwards = topology_.face(f).nodes;
      add(f, same_direction(face, outwards) ? face : face.reversed());
    }
    return numbers_[at(f)];
  }

  void add_others() {
    for (const bool inner : {false, true})
      for (Index f = 0; f < topology_.face_count(); ++f) {
        if (numbers_[at(f)] != 0) continue;
        const auto [nodes, elements] = topology_.face(f);
        if ((elements[1] >= 0) == inner) add(f, nodes);
      }
  }

  struct Item {
    Face nodes;
    std::array<Index, 2> elements;  ///< the first sees the face from outside; -1: none
  };
  const std::vector<Item>& list() const { return list_; }

 private:
  void add(Index f, const Face& nodes) {
    list_.push_back({nodes, topology_.face(f).elements});
    numbers_[at(f)] = index_count(list_.size(), "faces of a CGNS file");
  }

  const Topology& topology_;
  std::vector<Index> numbers_;
  std::vector<Item> list_;
};

/// The faces of each cell, negative for the cell that sees them from inside.
std::vector<Integers> faces_of_cells(const std::vector<FaceOrder::Item>& faces, Index cells) {
  std::vector<Integers> of_cells(at(cells));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto number = static_cast<std::int32_t>(f) + 1;
    of_cells[at(faces[f].elements[0])].push_back(number);
    if (faces[f].elements[1] >= 0) of_cells[at(faces[f].elements[1])].push_back(-number);
  }
  return of_cells;
}

/// ParentElements: the numbers of the cells that faces point out of, then of those that they point
/// into; 0: none. ParentElementsPosition: the places of the faces in the lists of these cells.
/// libcgns reads either only if it finds both.
std::array<NodePtr, 2> parents_of(const std::vector<Integers>& of_cells, Index face_count) {
  const auto n = at(face_count);
  Integers parents(2 * n, 0), positions(2 * n, 0);
  for (std::size_t c = 0; c < of_cells.size(); ++c)
    for (std::size_t k = 0; k < of_cells[c].size(); ++k) {
      const std::int32_t face = of_cells[c][k];
      const std::size_t place = face > 0 ? at(face) - 1 : n + at(-face) - 1;
      parents[place] = face_count + static_cast<std::int32_t>(c) + 1;
      positions[place] = static_cast<std::int32_t>(k) + 1;
    }
  return {make_integers("ParentElements", "DataArray_t", parents, {face_count, 2}),
          make_integers("ParentElementsPosition", "DataArray_t", positions, {face_count, 2})};
}

}  // namespace

std::shared_ptr<Node> make_section(std::string name, std::int64_t type, Index first, Index count,
                                   const Integers& connectivity, const Integers& starts) {
  auto section = make_integers(std::move(name), "Elements_t", {static_cast<std::int32_t>(type), 0});
  section->children.push_back(
      make_integers("ElementRange", "IndexRange_t", {first + 1, first + count}));
  section->children.push_back(make_integers("ElementConnectivity", "DataArray_t", connectivity));
  if (!starts.empty())
    section->children.push_back(make_integers("ElementStartOffset", "DataArray_t", starts));
  return section;
}

FaceSections make_face_sections(const Topology& topology, std::span<const Marker> markers,
                                bool start_offsets) {
  FaceSections sections;
  FaceOrder order(topology);
  for (const Marker& marker : markers) {
    auto& numbers = sections.markers.emplace_back();
    for (const Face& face : marker.faces) numbers.push_back(order.number_of(face));
  }
  order.add_others();
  const auto& faces = order.list();
  sections.face_count = static_cast<Index>(faces.size());
  index_count(faces.size() + at(topology.element_count()), "elements of a CGNS file");
  PolySection polygons(start_offsets), polyhedra(start_offsets);
  for (const auto& face : faces) {
    polygons.begin(face.nodes.size());
    for (const Index node : face.nodes) polygons.add(node + 1);
    polygons.end();
  }
  const std::vector<Integers> of_cells = faces_of_cells(faces, topology.element_count());
  for (const Integers& cell : of_cells) {
    polyhedra.begin(cell.size());
    for (const std::int32_t face : cell) polyhedra.add(face);
    polyhedra.end();
  }
  sections.faces = polygons.node("NgonElements", ngon_n, 0);
  for (const NodePtr& parents : parents_of(of_cells, sections.face_count))
    sections.faces->children.push_back(parents);
  sections.cells = polyhedra.node("NfaceElements", nface_n, sections.face_count);
  return sections;
}

}  // namespace winslow::io::cgns
