#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/types.h"

namespace winslow {

/// The corners of one face in cyclic order: two of an edge, which is a face of plane and surface
/// elements; three or four of a face of volume elements.
class Face {
 public:
  constexpr Face() = default;
  constexpr Face(Index a, Index b) : nodes_{a, b, -1, -1}, count_(2) {}
  constexpr Face(Index a, Index b, Index c) : nodes_{a, b, c, -1}, count_(3) {}
  constexpr Face(Index a, Index b, Index c, Index d) : nodes_{a, b, c, d}, count_(4) {}
  /// Throws UsageError unless there are two, three or four nodes.
  explicit Face(std::span<const Index> nodes);

  constexpr std::size_t size() const { return static_cast<std::size_t>(count_); }
  constexpr Index operator[](std::size_t k) const { return nodes_[k]; }
  constexpr const Index* begin() const { return nodes_.data(); }
  constexpr const Index* end() const { return nodes_.data() + count_; }

  /// The two nodes of an edge. Throws UsageError for a face of a volume mesh.
  std::array<Index, 2> edge() const {
    if (count_ != 2) refuse_edge();
    return {nodes_[0], nodes_[1]};
  }

  /// The face as seen from its other side; the first node of three or four stays.
  constexpr Face reversed() const {
    if (count_ == 2) return {nodes_[1], nodes_[0]};
    return count_ == 3 ? Face(nodes_[0], nodes_[2], nodes_[1])
                       : Face(nodes_[0], nodes_[3], nodes_[2], nodes_[1]);
  }

  /// Ascending; ends in -1 where there are fewer than four. The same for every order of the nodes.
  std::array<Index, 4> sorted() const;

  constexpr bool operator==(const Face&) const = default;

 private:
  [[noreturn]] void refuse_edge() const;

  std::array<Index, 4> nodes_{-1, -1, -1, -1};
  Index count_ = 0;
};

/// A face given by the numbers of an element's corners, by the nodes at these corners.
constexpr Face by_nodes(const Face& face, std::span<const Index> corners) {
  const auto node = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k])]; };
  if (face.size() == 2) return {node(0), node(1)};
  return face.size() == 3 ? Face(node(0), node(1), node(2))
                          : Face(node(0), node(1), node(2), node(3));
}

/// "nodes 3 and 5", "nodes 3, 5 and 9": as messages name a face.
std::string nodes_text(const Face& face);

/// Linear elements: two of plane and surface meshes, four of volume meshes.
enum class ElementType : std::uint8_t {
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  prism,
  hexahedron
};
inline constexpr std::array<ElementType, 6> all_element_types{
    ElementType::triangle, ElementType::quadrilateral, ElementType::tetrahedron,
    ElementType::pyramid,  ElementType::prism,         ElementType::hexahedron};

/// What an element of one type is made of, by the numbers of its corners.
///
/// Corners, edges and faces are numbered as CGNS does (SIDS, "Unstructured Grid Element Numbering
/// Conventions": TRI_3, QUAD_4, TETRA_4, PYRA_5, PENTA_6, HEXA_8), counted from zero. VTK numbers
/// corners alike, but for its wedge, whose triangle 0 1 2 faces outwards: the mirror image of a
/// prism, which a mesh turns when it orients its elements.
///
///     tetrahedron   base 0 1 2 seen from 3 counter-clockwise
///     pyramid       base 0 1 2 3 seen from the apex 4 counter-clockwise
///     prism         triangles 0 1 2 and 3 4 5; 3 above 0, 4 above 1, 5 above 2
///     hexahedron    quadrilaterals 0 1 2 3 and 4 5 6 7; 4 above 0 and so on
struct ElementShape {
  std::string_view name;  ///< "tetrahedron", for messages
  int dimension;          ///< 2 or 3
  /// #corners: places in the reference element (VTK's parametric coordinates: unit simplices, the
  /// unit square and cube, an apex above the centre of the unit square); z is 0 in two dimensions.
  std::span<const std::array<double, 3>> corners;
  /// The edges; as long as the faces for a plane element, whose edges are its faces.
  std::span<const std::array<Index, 2>> edges;
  /// What separates the element from its neighbours. Of a plane element the edges, the element on
  /// their left; of a volume element triangles and quadrilaterals, seen from outside
  /// counter-clockwise.
  std::span<const Face> faces;
  /// #corners: the ends of the edges at a corner. Of a plane element the next corner and the
  /// previous one, counter-clockwise seen from the corner; of a volume element three or, at the
  /// apex of a pyramid, four, clockwise seen from the corner: the polygon that cuts it off, its
  /// normal pointing away from it.
  std::span<const Face> links;
  /// #corners: the corners in the order that turns the element inside out; the first stays.
  std::span<const Index> mirrored;
};

const ElementShape& shape_of(ElementType type);

/// Number of corners of an element.
constexpr Index corner_count(ElementType type) {
  constexpr std::array<Index, 6> counts{3, 4, 4, 5, 6, 8};
  return counts[static_cast<std::size_t>(type)];
}
/// 2 of triangles and quadrilaterals, 3 of the others.
constexpr int dimension_of(ElementType type) { return type < ElementType::tetrahedron ? 2 : 3; }

}  // namespace winslow
