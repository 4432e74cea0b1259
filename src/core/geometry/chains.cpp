#include "core/geometry/chains.h"

#include <algorithm>
#include <set>
#include <utility>

namespace winslow {

namespace {

class Walk {
 public:
  Walk(const EdgeEnds& ends, const std::function<bool(Index)>& passes)
      : ends_(ends), passes_(passes) {}

  bool walked(Index a, Index b) const { return walked_.contains(std::minmax(a, b)); }

  Chain from(Index first, Index second) {
    Chain chain{{first}, false};
    Index before = first, node = second;
    for (;;) {
      walked_.insert(std::minmax(before, node));
      chain.nodes.push_back(node);
      if (node == first || !passes_(node)) return chain;
      const auto& around = ends_.at(node);
      const Index next = around[0] == before ? around[1] : around[0];
      before = std::exchange(node, next);
    }
  }

 private:
  const EdgeEnds& ends_;
  const std::function<bool(Index)>& passes_;
  std::set<std::pair<Index, Index>> walked_;
};

}  // namespace

std::vector<Chain> find_chains(const EdgeEnds& ends, const std::function<bool(Index)>& passes) {
  Walk walk(ends, passes);
  std::vector<Chain> chains;
  for (const auto& [node, around] : ends)
    if (!passes(node))
      for (const Index other : around)
        if (!walk.walked(node, other)) chains.push_back(walk.from(node, other));
  for (const auto& [node, around] : ends)
    if (passes(node) && !walk.walked(node, around[0]) && !walk.walked(node, around[1])) {
      Chain ring = walk.from(node, around[0]);
      ring.nodes.pop_back();
      ring.closed = true;
      chains.push_back(std::move(ring));
    }
  return chains;
}

}  // namespace winslow
