#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/types.h"

namespace winslow {

enum class ElementType : std::uint8_t { triangle, quadrilateral };

/// Number of corners of an element.
constexpr Index corner_count(ElementType type) { return type == ElementType::triangle ? 3 : 4; }

/// A named part of the boundary. Edges keep the order and the direction of the file.
struct Marker {
  std::string name;
  int tag = 0;  ///< physical tag (Gmsh); 1, 2, ... where the format has none
  std::vector<std::array<Index, 2>> edges;
};

/// A named set of elements (Gmsh physical surface). Formats without regions have none.
struct Region {
  std::string name;
  int tag = 0;
};

/// What a mesh file says, before anybody has checked it: the input of make_mesh.
struct MeshData {
  Coordinates coordinates;                ///< #nodes by 2
  std::vector<ElementType> types;         ///< #elements
  std::vector<Index> element_offsets{0};  ///< #elements + 1, into element_nodes
  std::vector<Index> element_nodes;       ///< corners of all elements, any orientation
  std::vector<Marker> markers;
  std::vector<Region> regions;
  std::vector<Index> element_region;  ///< #elements, index into regions or -1; empty: no regions

  Index node_count() const { return coordinates.size(); }
  Index element_count() const { return static_cast<Index>(types.size()); }
  std::span<const Index> element(Index e) const {
    const auto b = static_cast<std::size_t>(element_offsets[static_cast<std::size_t>(e)]);
    const auto n = static_cast<std::size_t>(element_offsets[static_cast<std::size_t>(e) + 1]) - b;
    return {element_nodes.data() + b, n};
  }
  void add_element(ElementType type, std::span<const Index> corners) {
    types.push_back(type);
    element_nodes.insert(element_nodes.end(), corners.begin(), corners.end());
    element_offsets.push_back(static_cast<Index>(element_nodes.size()));
  }
};

}  // namespace winslow
