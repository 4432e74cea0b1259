#include "core/formulation/node_pattern.h"

#include <algorithm>

namespace winslow {

NodePattern::NodePattern(const Topology& topology, std::span<const Index> nodes)
    : row_of_node(static_cast<std::size_t>(topology.node_count()), -1),
      entry_of_neighbour(topology.neighbour_rows().values.size(), -1) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    row_of_node[static_cast<std::size_t>(nodes[i])] = static_cast<Index>(i);
  }
  auto built = std::make_shared<SparsityPattern>();
  std::vector<Index> row;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto neighbours = topology.neighbours(nodes[i]);
    row.assign(1, static_cast<Index>(i));
    for (const Index k : neighbours) {
      const Index r = row_of_node[static_cast<std::size_t>(k)];
      if (r >= 0) row.push_back(r);
    }
    std::sort(row.begin(), row.end());
    const auto entry_of = [&](Index r) {
      return built->offsets.back() +
             static_cast<Index>(std::lower_bound(row.begin(), row.end(), r) - row.begin());
    };
    built->diagonal.push_back(entry_of(static_cast<Index>(i)));
    const auto first = static_cast<std::size_t>(
        topology.neighbour_rows().offsets[static_cast<std::size_t>(nodes[i])]);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const Index r = row_of_node[static_cast<std::size_t>(neighbours[k])];
      if (r >= 0) entry_of_neighbour[first + k] = entry_of(r);
    }
    built->columns.insert(built->columns.end(), row.begin(), row.end());
    built->offsets.push_back(static_cast<Index>(built->columns.size()));
  }
  pattern = std::move(built);
}

}  // namespace winslow
