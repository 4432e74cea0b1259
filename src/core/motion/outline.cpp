#include "core/motion/outline.h"

#include <algorithm>

namespace winslow {

namespace {

/// Facets that make up a face.
template <int D>
std::vector<FacetNodes<D>> facets_of(const Face& face) {
  if constexpr (D == 2) {
    return {face.edge()};
  } else {
    std::vector<FacetNodes<D>> facets{{face[0], face[1], face[2]}};
    if (face.size() == 4) facets.push_back({face[0], face[2], face[3]});
    return facets;
  }
}

}  // namespace

template <int D>
Outline<D>::Outline(const Topology& topology, std::span<const Index> moving_nodes,
                    std::span<const Index> yielding) {
  std::vector<bool> yields(static_cast<std::size_t>(topology.node_count()), false);
  for (const Index node : yielding) yields[static_cast<std::size_t>(node)] = true;
  std::vector<unsigned char> moves(static_cast<std::size_t>(topology.node_count()), 0);
  for (const Index node : moving_nodes) moves[static_cast<std::size_t>(node)] = 1;
  const Index faces = topology.face_count();
  constexpr Index inside = -2;
  std::vector<Index> marker(static_cast<std::size_t>(faces), inside);
  for (Index f = 0; f < faces; ++f)
    if (topology.face(f).elements[1] < 0) marker[static_cast<std::size_t>(f)] = -1;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    for (const Face& face : topology.markers()[m].faces)
      if (const auto f = topology.find_face(face))
        marker[static_cast<std::size_t>(*f)] = static_cast<Index>(m);
  }
  for (Index f = 0; f < faces; ++f) {
    const Index own = marker[static_cast<std::size_t>(f)];
    if (own == inside) continue;
    const Face nodes_of_face = topology.face(f).nodes;
    if (std::ranges::any_of(nodes_of_face,
                            [&](Index node) { return yields[static_cast<std::size_t>(node)]; }))
      continue;
    for (const FacetNodes<D>& nodes : facets_of<D>(nodes_of_face)) add(nodes, own, moves);
  }
}

template <int D>
void Outline<D>::add(const FacetNodes<D>& nodes, Index marker,
                     const std::vector<unsigned char>& moves) {
  const auto count = std::ranges::count_if(
      nodes, [&](Index node) { return moves[static_cast<std::size_t>(node)] != 0; });
  if (count > 0 && count < D) joints.push_back(moving.facets.size());
  (count > 0 ? moving : fixed).add(nodes, marker);
}

template struct Outline<2>;
template struct Outline<3>;

}  // namespace winslow
