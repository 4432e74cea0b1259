#include "core/formulation/free_node_pattern.h"

#include <algorithm>

namespace winslow {

FreeNodePattern::FreeNodePattern(const Topology& topology)
    : row_of_node(static_cast<std::size_t>(topology.node_count()), -1),
      entry_of_neighbour(topology.neighbour_rows().values.size(), -1) {
  const auto free = topology.free_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    row_of_node[static_cast<std::size_t>(free[i])] = static_cast<Index>(i);
  }
  auto built = std::make_shared<SparsityPattern>();
  std::vector<Index> row;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto neighbours = topology.neighbours(free[i]);
    row.assign(1, static_cast<Index>(i));
    for (const Index node : neighbours) {
      const Index r = row_of_node[static_cast<std::size_t>(node)];
      if (r >= 0) row.push_back(r);
    }
    std::sort(row.begin(), row.end());
    const auto entry_of = [&](Index r) {
      return built->offsets.back() +
             static_cast<Index>(std::lower_bound(row.begin(), row.end(), r) - row.begin());
    };
    built->diagonal.push_back(entry_of(static_cast<Index>(i)));
    const auto first = static_cast<std::size_t>(
        topology.neighbour_rows().offsets[static_cast<std::size_t>(free[i])]);
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
