#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/types.h"

namespace winslow {

/// The tetrahedra that a node of a volume element and the ends of its three edges there make up, by
/// the numbers of the element's corners, the corner first: positively oriented in an element that
/// is not inverted.
///
/// One of a tetrahedron (itself), six of a prism, eight of a hexahedron. A pyramid has those of the
/// four corners of its base: they are the four that its apex and three of its neighbours make up.
std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type);

/// The tetrahedra that an edge (a, b) of a hexahedron, or one between the triangles of a prism,
/// makes up with an edge at a and one of the other face at b, a the first node and b the second:
/// two of each such edge. Six times their volumes together are twice the coefficient of the
/// Jacobian along the edge in Bernstein's basis that is not its value at an end (A. Johnen, J.-F.
/// Remacle, C. Geuzaine, J. Comput. Phys. 233, 2013): where all of them and all corner tetrahedra
/// are positively oriented, the Jacobian is positive along all edges, and hardly ever negative
/// inside.
///
/// 24 of a hexahedron, six of a prism, none of the others, whose corners decide.
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

/// Six times the signed volume of an element of space: the flux of the position, relative to
/// `origin`, through its faces (divergence theorem), a third of it. A quadrilateral counts as the
/// bilinear surface through its corners, so neighbours agree on it exactly, up to sign and
/// round-off.
double signed_volume6(const Coordinates& x, ElementType type, std::span<const Index> corners,
                      const Vec3& origin);

}  // namespace winslow
