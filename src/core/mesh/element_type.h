#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/mesh/face.h"

namespace winslow {

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
