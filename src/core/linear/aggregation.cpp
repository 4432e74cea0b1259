#include "core/linear/aggregation.h"

#include <algorithm>
#include <numeric>

namespace winslow {

namespace {

/// Calls body(neighbour) for the rows that row i is strongly connected to.
template <typename Body>
void each_neighbour(const SparsityPattern& graph, std::span<const char> strong, Index i,
                    Body&& body) {
  for (auto e = at(graph.offsets[at(i)]); e < at(graph.offsets[at(i) + 1]); ++e) {
    if (graph.columns[e] != i && (strong.empty() || strong[e])) body(graph.columns[e]);
  }
}

/// Graph of the patches: two are connected if rows of theirs are.
SparsityPattern patch_graph(const SparsityPattern& graph, const Aggregates& patches) {
  std::vector<Index> start(at(patches.count) + 1, 0), members(graph.diagonal.size());
  for (const Index p : patches.of_row) {
    if (p >= 0) ++start[at(p) + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> next(start.begin(), start.end() - 1);
  for (Index i = 0; i < graph.rows(); ++i) {
    const Index p = patches.of_row[at(i)];
    if (p >= 0) members[at(next[at(p)]++)] = i;
  }
  SparsityPattern result;
  std::vector<Index> seen(at(patches.count), -1), row;
  for (Index p = 0; p < patches.count; ++p) {
    row.assign(1, p);
    seen[at(p)] = p;
    for (Index m = start[at(p)]; m < start[at(p) + 1]; ++m) {
      each_neighbour(graph, {}, members[at(m)], [&](Index j) {
        const Index q = patches.of_row[at(j)];
        if (q < 0 || seen[at(q)] == p) return;
        seen[at(q)] = p;
        row.push_back(q);
      });
    }
    result.columns.insert(result.columns.end(), row.begin(), row.end());
    result.diagonal.push_back(result.offsets.back());
    result.offsets.push_back(static_cast<Index>(result.columns.size()));
  }
  return result;
}

/// Rows sorted by the place of their patch, which keeps patches together.
std::vector<Index> sorted_by_patch(const Aggregates& patches,
                                   const std::vector<Index>& patch_order) {
  std::vector<Index> start(at(patches.count) + 2, 0), place(at(patches.count));
  for (std::size_t k = 0; k < patch_order.size(); ++k) {
    place[at(patch_order[k])] = static_cast<Index>(k);
  }
  // Rows of no patch come last.
  const auto place_of = [&](Index patch) { return patch >= 0 ? place[at(patch)] : patches.count; };
  for (const Index p : patches.of_row) ++start[at(place_of(p)) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> order(patches.of_row.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[at(start[at(place_of(patches.of_row[i]))]++)] = static_cast<Index>(i);
  }
  return order;
}

}  // namespace

Aggregates aggregate(const SparsityPattern& graph, std::span<const char> strong) {
  const Index n = graph.rows();
  Aggregates result;
  std::vector<Index>& of = result.of_row;
  of.assign(at(n), -1);
  // Whole neighbourhoods that nobody has touched.
  for (Index i = 0; i < n; ++i) {
    bool free = of[at(i)] < 0, connected = false;
    each_neighbour(graph, strong, i, [&](Index j) {
      connected = true;
      free = free && of[at(j)] < 0;
    });
    if (!free || !connected) continue;
    of[at(i)] = result.count;
    each_neighbour(graph, strong, i, [&](Index j) { of[at(j)] = result.count; });
    ++result.count;
  }
  // What is left over joins a neighbour of the first round, the smallest for even sizes.
  const std::vector<Index> first = of;
  std::vector<Index> size(at(result.count), 0);
  for (const Index a : of) {
    if (a >= 0) ++size[at(a)];
  }
  for (Index i = 0; i < n; ++i) {
    if (of[at(i)] >= 0) continue;
    Index best = -1;
    each_neighbour(graph, strong, i, [&](Index j) {
      const Index a = first[at(j)];
      if (a >= 0 && (best < 0 || size[at(a)] < size[at(best)])) best = a;
    });
    of[at(i)] = best;
    if (best >= 0) ++size[at(best)];
  }
  // Where the connections are one-way, some have no such neighbour: they stay among themselves.
  for (Index i = 0; i < n; ++i) {
    if (of[at(i)] >= 0) continue;
    bool connected = false;
    each_neighbour(graph, strong, i, [&](Index j) {
      connected = true;
      if (of[at(j)] < 0) of[at(j)] = result.count;
    });
    if (connected) of[at(i)] = result.count++;
  }
  return result;
}

std::vector<Index> locality_ordering(const SparsityPattern& graph) {
  const Aggregates patches = aggregate(graph);
  std::vector<Index> patch_order(at(patches.count));
  std::iota(patch_order.begin(), patch_order.end(), 0);
  if (patches.count > 1) patch_order = locality_ordering(patch_graph(graph, patches));
  return sorted_by_patch(patches, patch_order);
}

}  // namespace winslow
