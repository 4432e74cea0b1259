#pragma once

#include <memory>
#include <vector>

#include "core/outer/line_search.h"

namespace winslow {

/// For where only steps that are hardly any lead down: the nodes that do not let the others go
/// further are held from now on, `problem` becomes the one that holds them
/// (EnergyProblem::holding_stuck_nodes()), and the search goes on. direction: that of the last
/// system; solve() solves the one of the problem now at x, puts its direction there and returns the
/// slope along it; search(slope, shortest) is false if no step of `shortest` or more leads down.
template <class Problem, class Solve, class Search>
bool search_without_stuck_nodes(std::shared_ptr<const Problem>& problem, const Coordinates& x,
                                const std::vector<double>& direction, double slope, Solve solve,
                                Search search) {
  constexpr int most_times = 10;
  for (int i = 0; i < most_times; ++i) {
    auto other = std::dynamic_pointer_cast<const Problem>(
        problem->holding_stuck_nodes(x, direction, shortest_step));
    if (!other) break;
    problem = std::move(other);
    slope = solve();
    if (slope > 0 && search(slope, shortest_step)) return true;
  }
  return search(slope, 0);
}

}  // namespace winslow
