#include "io/format/cell_of_faces.h"

#include "core/parallel/parallel_for.h"
#include "core/quality/volume_element.h"

namespace winslow::io {
namespace {

std::optional<ElementType> type_of(std::span<const Face> faces) {
  const auto triangles =
      std::ranges::count_if(faces, [](const Face& face) { return face.size() == 3; });
  const auto others = static_cast<std::ptrdiff_t>(faces.size()) - triangles;
  if (triangles == 4 && others == 0) return ElementType::tetrahedron;
  if (triangles == 4 && others == 1) return ElementType::pyramid;
  if (triangles == 2 && others == 3) return ElementType::prism;
  if (triangles == 0 && others == 6) return ElementType::hexahedron;
  return std::nullopt;
}

bool has(const Face& face, Index node) {
  return std::find(face.begin(), face.end(), node) != face.end();
}

/// The neighbour of `corner` in one of the faces that is not in the base; -1: there is none.
Index above(Index corner, const Face& base, std::span<const Face> faces) {
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (face[k] != corner) continue;
      for (const std::size_t step : {std::size_t{1}, face.size() - 1}) {
        const Index next = face[(k + step) % face.size()];
        if (!has(base, next)) return next;
      }
    }
  }
  return -1;
}

/// True if the faces of the element are these.
bool same_faces(const CellOfFaces& cell, std::span<const Face> faces) {
  std::vector<Face> own, given;
  for (const Face& face : shape_of(cell.type).faces)
    own.push_back(by_nodes(face, cell.corners).sorted());
  for (const Face& face : faces) given.push_back(face.sorted());
  std::ranges::sort(own);
  std::ranges::sort(given);
  return own == given;
}

}  // namespace

std::optional<CellOfFaces> cell_of_faces(std::span<const Face> faces) {
  const auto type = type_of(faces);
  if (!type) return std::nullopt;
  const bool on_triangle = *type == ElementType::tetrahedron || *type == ElementType::prism;
  const std::size_t base_size = on_triangle ? 3 : 4;
  const Face& base =
      *std::ranges::find_if(faces, [&](const Face& face) { return face.size() == base_size; });
  // Corners 0 1 2 (3) of an element are clockwise seen from outside its base.
  CellOfFaces cell{*type, {}};
  for (const Index node : base.reversed()) cell.corners.push_back(node);
  const bool pointed = *type == ElementType::tetrahedron || *type == ElementType::pyramid;
  const std::size_t upper = pointed ? 1 : base_size;
  for (std::size_t k = 0; k < upper; ++k)
    cell.corners.push_back(above(cell.corners[k], base, faces));
  if (std::ranges::find(cell.corners, -1) != cell.corners.end()) return std::nullopt;
  if (!same_faces(cell, faces)) return std::nullopt;
  return cell;
}

void add_cell_of_faces(std::span<const Face> faces, MeshData& data) {
  if (std::ranges::all_of(faces, [](const Face& face) { return face.size() <= 4; })) {
    if (const auto cell = cell_of_faces(faces)) return data.add_element(cell->type, cell->corners);
  }
  data.add_polyhedron(faces);
}

namespace {

/// An edge of a face, and whether the face goes through it from the lower node to the higher one.
struct FaceEdge {
  Index low, high;
  std::size_t face;
  bool ascends;
};

class FacesOfCell {
 public:
  FacesOfCell(std::vector<Face>& faces, Index first_node)
      : faces_(faces), first_node_(first_node) {}

  Index make_alike() {
    if (faces_.size() < 4)
      throw FacesFault{std::to_string(faces_.size()) + " faces", "four or more"};
    for (const Face& face : faces_) check(face);
    find_edges();
    if (std::ranges::none_of(edges_, [&](const FaceEdge& edge) { return !meets_opposite(edge); }))
      return 0;
    return turn();
  }

 private:
  std::string text_of(const Face& face) const {
    std::vector<Index> nodes;
    for (const Index node : face) nodes.push_back(node + first_node_);
    return nodes_text(Face(nodes));
  }

  void check(const Face& face) const {
    if (face.size() < 3)
      throw FacesFault{"a face of " + std::to_string(face.size()) + " nodes", "three or more"};
    const Face sorted = face.sorted();
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw FacesFault{"a face with a node twice: " + text_of(face), "distinct nodes"};
  }

  /// Lists the edges, the two faces of each next to each other.
  void find_edges() {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Index a = face[k], b = face[(k + 1) % face.size()];
        edges_.push_back({std::min(a, b), std::max(a, b), f, a < b});
      }
    }
    const auto nodes = [](const FaceEdge& edge) { return std::pair(edge.low, edge.high); };
    std::ranges::sort(edges_, [&](const FaceEdge& a, const FaceEdge& b) {
      return std::pair(nodes(a), a.face) < std::pair(nodes(b), b.face);
    });
    for (std::size_t k = 0, end = 0; k < edges_.size(); k = end) {
      while (end < edges_.size() && nodes(edges_[end]) == nodes(edges_[k])) ++end;
      if (end - k == 2) continue;
      throw FacesFault{std::to_string(end - k) + (end - k == 1 ? " face" : " faces") +
                           " at the edge between " + text_of({edges_[k].low, edges_[k].high}),
                       "two: the faces of a cell close"};
    }
  }

  const FaceEdge& opposite(const FaceEdge& edge) const {
    const auto k = static_cast<std::size_t>(&edge - edges_.data());
    return edges_[k % 2 == 0 ? k + 1 : k - 1];
  }
  bool meets_opposite(const FaceEdge& edge) const { return edge.ascends != opposite(edge).ascends; }

  /// Goes from face to face over the edges, and turns those that do not face as the first one.
  Index turn() {
    std::vector<std::vector<const FaceEdge*>> of_face(faces_.size());
    for (const FaceEdge& edge : edges_) of_face[edge.face].push_back(&edge);
    std::vector<signed char> turned(faces_.size(), -1);
    std::vector<std::size_t> reached{0};
    turned[0] = 0;
    for (std::size_t r = 0; r < reached.size(); ++r) {
      const std::size_t face = reached[r];
      for (const FaceEdge* edge : of_face[face]) {
        const std::size_t other = opposite(*edge).face;
        const auto wanted =
            static_cast<signed char>(meets_opposite(*edge) ? turned[face] : 1 - turned[face]);
        if (turned[other] < 0) reached.push_back(other);
        if (turned[other] >= 0 && turned[other] != wanted)
          throw FacesFault{"faces that are a one-sided surface", "the boundary of a solid"};
        turned[other] = wanted;
      }
    }
    if (reached.size() < faces_.size())
      throw FacesFault{"faces in separate parts, of which some are seen from inside",
                       "one closed surface"};
    Index count = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (turned[f] == 0) continue;
      faces_[f] = faces_[f].reversed();
      ++count;
    }
    return count;
  }

  std::vector<Face>& faces_;
  Index first_node_;
  std::vector<FaceEdge> edges_;
};

}  // namespace

Index make_faces_alike(std::vector<Face>& faces, Index first_node) {
  return FacesOfCell(faces, first_node).make_alike();
}

bool same_direction(const Face& a, const Face& b) {
  const auto second = [](const Face& face, Index first) {
    return face[(index_of(face, first) + 1) % face.size()];
  };
  return second(a, a[0]) == second(b, a[0]);
}

namespace {

/// Whether a cell is inverted, or flat at a corner, as the element that it is, and sound as one of
/// finite volumes.
bool is_sound_by_faces(const MeshData& data, Index e) {
  const auto corners = data.element(e);
  const SpacePoints x(data.coordinates);
  const ElementShape& shape = shape_of(data.types[at(e)]);
  std::vector<Vec3> places;
  for (const Index node : corners) places.emplace_back(x[node]);
  if (!has_flat_corner(shape, places) && has_positive_jacobian(x, shape, corners)) return false;
  const PolyhedronShape by_faces(shape.faces, places);
  return has_positive_jacobian(x, by_faces.shape(), corners);
}

}  // namespace

void give_faces_to_flat_cells(ParsedMesh& mesh) {
  MeshData& data = mesh.data;
  if (!data.has_polyhedra()) return;
  std::vector<unsigned char> by_faces(at(data.element_count()), 0);
  parallel_for(0, data.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (data.types[at(e)] != ElementType::polyhedron)
        by_faces[at(e)] = is_sound_by_faces(data, e) ? 1 : 0;
  });
  const auto found = static_cast<Index>(std::ranges::count(by_faces, 1));
  if (found == 0) return;
  MeshData out = std::move(data);
  std::vector<ElementType> types = std::exchange(out.types, {});
  const std::vector<Index> nodes = std::exchange(out.element_nodes, {});
  const std::vector<Index> offsets = std::exchange(out.element_offsets, {0});
  const std::vector<Face> faces = std::exchange(out.faces, {});
  const std::vector<Index> face_offsets = std::exchange(out.face_offsets, {});
  const auto row = [](const auto& values, const std::vector<Index>& begin, std::size_t k) {
    return std::span(values).subspan(at(begin[k]), at(begin[k + 1] - begin[k]));
  };
  std::vector<Face> own;
  for (std::size_t e = 0; e < types.size(); ++e) {
    const auto corners = row(nodes, offsets, e);
    if (types[e] == ElementType::polyhedron) {
      out.add_polyhedron(corners, row(faces, face_offsets, e));
    } else if (by_faces[e] == 0) {
      out.add_element(types[e], corners);
    } else {
      own.clear();
      for (const Face& face : shape_of(types[e]).faces) own.push_back(by_nodes(face, corners));
      out.add_polyhedron(corners, own);
    }
  }
  data = std::move(out);
  mesh.warnings.push_back(std::to_string(found) + (found == 1 ? " cell is" : " cells are") +
                          " inverted or flat at a corner and sound by the faces, as checkMesh "
                          "sees them: taken as polyhedra, without the corners that are flat");
}

}  // namespace winslow::io
