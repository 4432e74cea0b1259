#pragma once

#include <compare>
#include <memory>

#include "core/mesh/coordinates.h"
#include "core/types.h"

namespace winslow {

/// The nodes of one face in cyclic order. Faces of plane and surface elements are edges, with two
/// nodes; those of volume elements have three or more. Up to four are stored in place.
class Face {
 public:
  constexpr Face() = default;
  constexpr Face(Index a, Index b) : nodes_{a, b, -1, -1}, count_(2) {}
  constexpr Face(Index a, Index b, Index c) : nodes_{a, b, c, -1}, count_(3) {}
  constexpr Face(Index a, Index b, Index c, Index d) : nodes_{a, b, c, d}, count_(4) {}
  /// Throws UsageError unless there are at least two nodes.
  explicit Face(std::span<const Index> nodes);

  constexpr Face(const Face& other) : nodes_(other.nodes_), count_(other.count_) {
    if (is_long()) own_list();
  }
  constexpr Face(Face&& other) noexcept : nodes_(other.nodes_), count_(other.count_) {
    if (is_long()) other.count_ = 0;
  }
  constexpr Face& operator=(const Face& other) {
    if (is_long() || other.is_long()) {
      Face copy(other);
      swap(copy);
    } else {
      nodes_ = other.nodes_;
      count_ = other.count_;
    }
    return *this;
  }
  constexpr Face& operator=(Face&& other) noexcept {
    swap(other);
    return *this;
  }
  constexpr ~Face() {
    if (is_long()) free_list();
  }
  constexpr void swap(Face& other) noexcept {
    std::swap(nodes_, other.nodes_);
    std::swap(count_, other.count_);
  }

  constexpr std::size_t size() const { return static_cast<std::size_t>(count_); }
  constexpr Index operator[](std::size_t k) const { return begin()[k]; }
  constexpr const Index* begin() const { return is_long() ? list() : nodes_.data(); }
  constexpr const Index* end() const { return begin() + count_; }

  /// The two nodes of an edge. Throws UsageError for a face of a volume mesh.
  std::array<Index, 2> edge() const {
    if (count_ != 2) refuse_edge();
    return {nodes_[0], nodes_[1]};
  }

  /// The nodes in the opposite direction; the first of three or more stays the first.
  constexpr Face reversed() const {
    if (count_ == 2) return {nodes_[1], nodes_[0]};
    if (is_long()) return long_reversed();
    return count_ == 3 ? Face(nodes_[0], nodes_[2], nodes_[1])
                       : Face(nodes_[0], nodes_[3], nodes_[2], nodes_[1]);
  }

  /// The nodes ascending: the same for every order of the nodes.
  Face sorted() const;

  constexpr bool operator==(const Face& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }
  /// By the nodes, from the first on.
  constexpr std::strong_ordering operator<=>(const Face& other) const {
    return std::lexicographical_compare_three_way(begin(), end(), other.begin(), other.end());
  }

 private:
  static constexpr Index in_place = 4;
  constexpr bool is_long() const { return count_ > in_place; }
  /// The nodes of a long face. The address of their list is stored in nodes_, so that a mesh of
  /// short faces, of which there are millions, needs no more memory.
  const Index* list() const;
  /// Makes a copy of the list of another face.
  void own_list();
  void put_list(std::unique_ptr<Index[]> nodes);
  void free_list() const;
  Face long_reversed() const;
  [[noreturn]] void refuse_edge() const;

  std::array<Index, 4> nodes_{-1, -1, -1, -1};
  Index count_ = 0;
};

/// The nodes of a face that is given by the numbers of an element's corners.
constexpr Face by_nodes(const Face& face, std::span<const Index> corners) {
  const auto node = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k])]; };
  if (face.size() == 2) return {node(0), node(1)};
  if (face.size() == 3) return {node(0), node(1), node(2)};
  if (face.size() == 4) return {node(0), node(1), node(2), node(3)};
  std::vector<Index> nodes;
  for (const Index k : face) nodes.push_back(corners[static_cast<std::size_t>(k)]);
  return Face(std::span<const Index>(nodes));
}

/// "nodes 3 and 5", "nodes 3, 5 and 9": a face in messages.
std::string nodes_text(const Face& face);

/// Linear elements: triangles and quadrilaterals of plane and surface meshes, polygons of plane
/// meshes, the others of volume meshes. A polygon has any number of corners. A polyhedron has any
/// number of faces, and these have any number of corners. The order is that of saved sessions.
enum class ElementType : std::uint8_t {
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  prism,
  hexahedron,
  polyhedron,
  polygon
};
inline constexpr std::size_t element_type_count = 8;
/// All types but polyhedra and polygons: those of which all elements have one shape.
inline constexpr std::array<ElementType, 6> fixed_element_types{
    ElementType::triangle, ElementType::quadrilateral, ElementType::tetrahedron,
    ElementType::pyramid,  ElementType::prism,         ElementType::hexahedron};

/// Edges, faces and links of an element, by the numbers of its corners: of all elements of one
/// type, of one polyhedron (PolyhedronShape), or of all polygons with the same flat corners
/// (PolygonShape).
///
/// Corners, edges and faces are numbered as CGNS does (SIDS, "Unstructured Grid Element Numbering
/// Conventions": TRI_3, QUAD_4, TETRA_4, PYRA_5, PENTA_6, HEXA_8), counted from zero. VTK has the
/// same numbers of corners, except for its wedge: its triangle 0 1 2 faces outwards, so that it is
/// the mirror image of a prism. A mesh turns wedges when it orients its elements.
///
///     tetrahedron   base 0 1 2 seen from 3 counter-clockwise
///     pyramid       base 0 1 2 3 seen from the apex 4 counter-clockwise
///     prism         triangles 0 1 2 and 3 4 5; 3 above 0, 4 above 1, 5 above 2
///     hexahedron    quadrilaterals 0 1 2 3 and 4 5 6 7; 4 above 0 and so on
struct ElementShape {
  ElementType type = ElementType::polyhedron;
  std::string_view name;  ///< "tetrahedron", for messages
  int dimension;          ///< 2 or 3
  /// #corners: places in the reference element (VTK's parametric coordinates: unit simplices, the
  /// unit square and cube, an apex above the centre of the unit square); z is 0 in two dimensions.
  /// Empty for polyhedra and polygons.
  std::span<const std::array<double, 3>> corners;
  /// The edges; of a plane element they are its faces, too.
  std::span<const std::array<Index, 2>> edges;
  /// The faces. Of a plane element they are its edges, with the element on their left; of a volume
  /// element triangles and quadrilaterals, counter-clockwise seen from outside.
  std::span<const Face> faces;
  /// #corners: the link of each corner, which has the other ends of the edges at the corner. Of a
  /// plane element they are the next corner and the previous one, counter-clockwise seen from the
  /// corner. Of a volume element they are three or, at the apex of a pyramid, four, clockwise seen
  /// from the corner: a polygon whose normal points away from the corner.
  std::span<const Face> links;
  /// #corners: the corners in the order that turns the element inside out; the first stays. Empty
  /// for polyhedra, of which the faces are turned.
  std::span<const Index> mirrored;
  /// Of a volume element: see corner_tetrahedra() and edge_tetrahedra().
  std::span<const std::array<Index, 4>> corner_tetrahedra = {}, edge_tetrahedra = {};
  /// Tetrahedra over the faces of a polyhedron at its flat corners (PolyhedronShape).
  std::span<const std::array<Index, 4>> face_tetrahedra = {};
  /// For each corner tetrahedron of a polyhedron, the numbers of corners of the three faces between
  /// its edges (PolyhedronShape, regular_corner()).
  std::span<const std::array<std::uint8_t, 3>> face_sizes = {};
  /// The type with the same faces; of a polyhedron that is like no other type, polyhedron.
  ElementType like = type;
  /// Of a polyhedron: number of corners that are neither flat nor inside a straight edge. Of a
  /// plane element: number of corners that are not flat.
  Index real_corners = 0;
  /// Of a plane element: triangles of a corner, the next corner and the previous one. The first
  /// real_corners of them are those of all corners that are not flat, ascending. Others are at flat
  /// corners between flat ones, with a third corner across the polygon instead of the previous one.
  std::span<const std::array<Index, 3>> corner_triangles = {};
  /// Of a polygon, for each corner that is not flat: the number of edges from it to the next such
  /// corner, and to the previous one.
  std::span<const std::array<Index, 2>> side_edges = {};
};

/// The shape of all elements of a type; that of polyhedra and polygons is empty.
const ElementShape& shape_of(ElementType type);

/// Number of corners of an element; 0 of polyhedra and polygons, which have any number.
constexpr Index corner_count(ElementType type) {
  constexpr std::array<Index, element_type_count> counts{3, 4, 4, 5, 6, 8, 0, 0};
  return counts[static_cast<std::size_t>(type)];
}
/// 2 of triangles, quadrilaterals and polygons, 3 of the others.
constexpr int dimension_of(ElementType type) {
  return type < ElementType::tetrahedron || type == ElementType::polygon ? 2 : 3;
}

/// A table with make(type) for each element type with one shape; empty for the others.
template <class Make>
auto table_by_type(const Make& make) {
  std::array<decltype(make(ElementType::triangle)), element_type_count> table;
  for (const ElementType type : fixed_element_types)
    table[static_cast<std::size_t>(type)] = make(type);
  return table;
}

/// The corner tetrahedra of a volume element: each corner with the other ends of its three edges,
/// by the numbers of corners, the corner first. They are positively oriented in an element that is
/// not inverted.
///
/// A tetrahedron has one (itself), a prism six, a hexahedron eight. A pyramid has those of the four
/// corners of its base; its apex has four edges, and any three of them give one of these again.
std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type);

/// Two tetrahedra for each edge (a, b) of a hexahedron and for each edge between the triangles of a
/// prism. Each has the edge (a, b), an edge at a, and an edge at b that lies in the other face at
/// (a, b); its first node is a and its second b.
///
/// Along the edge the Jacobian is a quadratic. Six times the sum of the two volumes is twice its
/// middle Bernstein coefficient (A. Johnen, J.-F. Remacle, C. Geuzaine, J. Comput. Phys. 233,
/// 2013). So if all of these tetrahedra and all corner tetrahedra are positively oriented, the
/// Jacobian is positive along all edges, and hardly ever negative inside.
///
/// A hexahedron has 24, a prism six, the others none: their corners decide.
std::span<const std::array<Index, 4>> edge_tetrahedra(ElementType type);

/// Places of the corners of the regular element: unit edges, equilateral triangles, square faces
/// (#corners).
std::span<const std::array<double, 3>> regular_corners(ElementType type);

/// A corner tetrahedron by the nodes of a mesh.
inline std::array<Index, 4> by_nodes(const std::array<Index, 4>& corners,
                                     std::span<const Index> element) {
  const auto node = [&](std::size_t k) { return element[at(corners[k])]; };
  return {node(0), node(1), node(2), node(3)};
}

/// Twice the signed area of a polygon of the plane (shoelace formula), relative to its first
/// corner; positive counter-clockwise.
double signed_area2(const Coordinates& x, std::span<const Index> corners);

/// Six times the signed volume of a volume element, by the divergence theorem: twice the flux of
/// the position relative to `origin` through its faces. A quadrilateral is the bilinear surface
/// through its corners, so its contributions to its two elements cancel up to round-off.
double signed_volume6(const Coordinates& x, const ElementShape& shape,
                      std::span<const Index> corners, const Vec3& origin);
/// The part of one face, given by the nodes of the mesh, counter-clockwise seen from outside. The
/// surface of a face of more than four nodes is that of the triangles about its middle.
double signed_volume6(const Coordinates& x, const Face& nodes, const Vec3& origin);

}  // namespace winslow
