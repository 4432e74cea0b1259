#pragma once

#include <array>
#include <span>

#include "core/index.h"
#include "core/mesh/element_type.h"

namespace winslow {

/// The tetrahedra that a node of a volume element and the ends of its three edges there make up, by
/// the numbers of the element's corners, the corner first: positively oriented in an element that
/// is not inverted.
///
/// One of a tetrahedron (itself), six of a prism, eight of a hexahedron. A pyramid has those of the
/// four corners of its base: they are the four that its apex and three of its neighbours make up.
std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type);

/// Places of the corners of the regular element: unit edges, equilateral triangles, square faces
/// (#corners).
std::span<const std::array<double, 3>> regular_corners(ElementType type);

/// A corner tetrahedron by the nodes of a mesh.
inline std::array<Index, 4> by_nodes(const std::array<Index, 4>& corners,
                                     std::span<const Index> element) {
  const auto node = [&](std::size_t k) { return element[at(corners[k])]; };
  return {node(0), node(1), node(2), node(3)};
}

}  // namespace winslow
