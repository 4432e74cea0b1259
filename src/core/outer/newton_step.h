#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/linear_solver.h"
#include "core/linear/sparse_system.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Share of a step along a direction below which it is looked for nodes that do not let the others
/// go further: EnergyProblem::holding_stuck_nodes().
inline constexpr double shortest_step = 0.15;

/// Step that a line search from the valid mesh x begins with: `longest`, or 0.9 of the exact
/// largest valid one where that is shorter.
double first_valid_step(const SmoothingProblem& problem, std::span<const double> direction,
                        double longest, const Coordinates& x);

/// Step to try after t has failed: the minimum of the parabola that falls by `slope` per unit at 0
/// and lies `rise` above that line at t, but between 0.1 t and 0.5 t.
double shorter_step(double t, double slope, double rise);

/// Where the parabola that falls by `slope` per unit at 0 and changes by `change` up to 1 has its
/// minimum; 1 if it has none.
double longer_step(double slope, double change);

/// Adds a share of each diagonal block's mean diagonal entry to its diagonal.
void shift_diagonal(SparseMatrix& matrix, double share);

/// Hands a matrix that is positive semidefinite by construction to a solver. Where round-off or
/// sizes too far apart spoil that, a growing share of each diagonal block's trace is added to its
/// diagonal until the solver takes it. `matrix` is changed accordingly.
/// Throws NotPositiveDefinite if even a share of one does not help.
void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix);

/// The same, and solves for one right-hand side: an iterative solver finds out only then.
/// `solution` is written from zero on.
LinearResult solve_shifted(LinearSolver& solver, SparseMatrix& matrix, std::span<const double> rhs,
                           std::span<double> solution);

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
