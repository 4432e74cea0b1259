#pragma once

#include <functional>
#include <map>
#include <vector>

#include "core/index.h"

namespace winslow {

/// Nodes one after the other along edges; a closed chain does not repeat its first.
struct Chain {
  std::vector<Index> nodes;
  bool closed = false;

  /// From a node that it does not pass round to the same.
  bool loop() const { return !closed && nodes.size() > 1 && nodes.front() == nodes.back(); }
};

/// The other ends of the edges at each node.
using EdgeEnds = std::map<Index, std::vector<Index>>;

/// Every edge in one chain. Chains run on through the nodes that `passes` says, all of which have
/// two edges, and end at the others; those that meet none of these are closed.
std::vector<Chain> find_chains(const EdgeEnds& ends, const std::function<bool(Index)>& passes);

}  // namespace winslow
