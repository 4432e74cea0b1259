#pragma once

#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/motion/facet.h"
#include "core/search/box_tree.h"

namespace winslow {

/// The facets of a mesh that may meet when some nodes move: those of the boundary and those of
/// markers inside. Quadrilaterals of volume meshes are two triangles.
template <int D>
struct Outline {
  struct Part {
    std::vector<FacetNodes<D>> facets;
    std::vector<Index> markers;  ///< of each facet; -1: none
    void add(const FacetNodes<D>& facet, Index marker) {
      facets.push_back(facet);
      markers.push_back(marker);
    }
  };
  Part moving;                      ///< with a node that moves
  Part fixed;                       ///< all others
  std::vector<std::size_t> joints;  ///< of `moving`, with a node that stays

  /// topology: of a plane (D = 2) or volume (D = 3) mesh. yielding: facets with a node of these are
  /// left out.
  Outline(const Topology& topology, std::span<const Index> moving_nodes,
          std::span<const Index> yielding = {});

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
