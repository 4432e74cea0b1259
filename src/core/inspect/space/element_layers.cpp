#include "core/inspect/space/element_layers.h"

namespace winslow {

std::vector<Index> element_layers(const Topology& topology, std::span<const Index> nodes) {
  std::vector<Index> layer(at(topology.element_count()), 0);
  std::vector<unsigned char> reached(at(topology.node_count()), 0);
  std::vector<Index> front(nodes.begin(), nodes.end()), next;
  for (const Index node : front) reached[at(node)] = 1;
  for (Index depth = 1; !front.empty(); ++depth) {
    next.clear();
    for (const Index node : front)
      for (const Index e : topology.star(node)) {
        if (layer[at(e)] != 0) continue;
        layer[at(e)] = depth;
        for (const Index other : topology.element(e)) {
          if (reached[at(other)] != 0) continue;
          reached[at(other)] = 1;
          next.push_back(other);
        }
      }
    front.swap(next);
  }
  return layer;
}

}  // namespace winslow
