#include "core/mesh/node_link.h"

#include <algorithm>

namespace winslow {

std::vector<Face> node_link(const Topology& topology, Index node) {
  std::vector<Face> link;
  link.reserve(topology.star(node).size());
  for (const Index e : topology.star(node)) {
    const auto corners = topology.element(e);
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    const ElementShape& shape = shape_of(topology.element_type(e));
    link.push_back(by_nodes(shape.links[static_cast<std::size_t>(corner)], corners));
  }
  return link;
}

}  // namespace winslow
