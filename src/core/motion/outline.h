#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/search/box_tree.h"

namespace winslow {

/// A flat piece of a boundary: a segment in the plane (D = 2), a triangle in space (D = 3).
template <int D>
using Facet = std::array<Vec<D>, D>;
template <int D>
using FacetNodes = std::array<Index, D>;

/// The intersection of two facets.
template <int D>
struct Meeting {
  enum class Kind {
    none,
    touch,    ///< a corner or an edge of one lies on the other, or they are coplanar and overlap
    crossing  ///< an edge of one passes through the interior of the other
  };
  Kind kind = Kind::none;
  Vec<D> place = Vec<D>::Zero();  ///< one of the common points
};
Meeting<2> meeting(const Facet<2>& s, const Facet<2>& t);
Meeting<3> meeting(const Facet<3>& s, const Facet<3>& t);

/// Distance between the nearest points of two facets; 0 if they meet.
double distance(const Facet<2>& s, const Facet<2>& t);
double distance(const Facet<3>& s, const Facet<3>& t);

template <int D>
Box<D> box_of(const Facet<D>& facet) {
  Box<D> box = Box<D>::empty();
  for (const Vec<D>& corner : facet) box.add(corner);
  return box;
}

template <std::size_t N>
bool share_node(const std::array<Index, N>& a, const std::array<Index, N>& b) {
  for (const Index node : a)
    for (const Index other : b)
      if (node == other) return true;
  return false;
}

template <std::size_t N>
Facet<static_cast<int>(N)> facet(const std::array<Index, N>& nodes, const Coordinates& x) {
  constexpr int D = static_cast<int>(N);
  Facet<D> out;
  for (std::size_t k = 0; k < N; ++k) out[k] = x.get<D>(nodes[k]);
  return out;
}

/// The facets of a mesh that may meet when some nodes move: those of the boundary, those of markers
/// inside, and those around what moves as a whole inside (the solid of a coupled mesh): all their
/// nodes move, and they do not lie between two elements all of whose nodes move. Faces of
/// volume meshes are cut into triangles.
template <int D>
struct Outline {
  static constexpr Index no_marker = -1, prescribed_inside = -2;

  struct Part {
    std::vector<FacetNodes<D>> facets;
    std::vector<Index> markers;  ///< of each facet; no_marker, prescribed_inside
    void add(const FacetNodes<D>& facet, Index marker) {
      facets.push_back(facet);
      markers.push_back(marker);
    }
  };
  Part moving;                      ///< with a moving node
  Part fixed;                       ///< all others
  std::vector<std::size_t> joints;  ///< indices into `moving`: facets that also have a fixed node

  /// topology: of a plane (D = 2) or volume (D = 3) mesh. x: where faces with more than three nodes
  /// are cut. yielding: facets with a node of these are left out.
  Outline(const Topology& topology, const Coordinates& x, std::span<const Index> moving_nodes,
          std::span<const Index> yielding = {});

  /// The name of a marker of `topology` for messages; "" for no_marker.
  static std::string marker_name(const Topology& topology, Index marker);

 private:
  void add(const FacetNodes<D>& nodes, Index marker, const std::vector<unsigned char>& moves);
};

extern template struct Outline<2>;
extern template struct Outline<3>;

template <std::size_t N>
BoxTree<static_cast<int>(N)> tree_of(const std::vector<std::array<Index, N>>& facets,
                                     const Coordinates& x) {
  constexpr int D = static_cast<int>(N);
  std::vector<Box<D>> boxes;
  boxes.reserve(facets.size());
  for (const auto& nodes : facets) boxes.push_back(box_of<D>(facet(nodes, x)));
  return BoxTree<D>(boxes);
}

}  // namespace winslow
