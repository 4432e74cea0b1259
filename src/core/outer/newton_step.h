#pragma once

#include "core/linear/linear_solver.h"
#include "core/linear/sparse_system.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// If a line search needs less than this share of the step, it looks for stuck nodes:
/// EnergyProblem::holding_stuck_nodes().
inline constexpr double shortest_step = 0.15;

/// Initial step of a line search from the valid mesh x: `longest`, or 0.9 of the exact largest
/// valid step if that is shorter.
double first_valid_step(const SmoothingProblem& problem, std::span<const double> direction,
                        double longest, const Coordinates& x);

/// The next step to try after t has failed, between 0.1 t and 0.5 t: the minimum of the parabola
/// that has the derivative -slope at 0 and lies `rise` above its tangent at t.
double shorter_step(double t, double slope, double rise);

/// The step that minimises the parabola with the derivative -slope at 0 that changes by `change`
/// from 0 to 1; 1 if it has no minimum.
double longer_step(double slope, double change);

/// Adds a share of each diagonal block's mean diagonal entry to its diagonal.
void shift_diagonal(SparseMatrix& matrix, double share);

/// Passes a matrix that is positive semidefinite by construction to a solver. If round-off or very
/// different sizes make it indefinite, adds a growing share of each diagonal block's trace to its
/// diagonal until the solver accepts it. `matrix` is changed accordingly. Throws
/// NotPositiveDefinite if even a share of one does not help.
void set_shifted_matrix(LinearSolver& solver, SparseMatrix& matrix);

/// The same, and solves for one right-hand side: an iterative solver detects indefiniteness only
/// then. The initial guess in `solution` is zero.
LinearResult solve_shifted(LinearSolver& solver, SparseMatrix& matrix, std::span<const double> rhs,
                           std::span<double> solution);

/// A line search that lowers the energy. If stuck nodes permit only very short steps, it replaces
/// `problem` by one that holds these nodes (EnergyProblem::holding_stuck_nodes()), solves for a new
/// direction and searches along it; it repeats this while more nodes are found. Returns false if no
/// step lowers the energy.
///
/// direction: of the last system; solve() overwrites it. slope: rate of decrease of the energy
/// along it. pass_checkpoint(): called before each round; ends the search by an exception. solve():
/// solves the system of `problem` at x and returns the slope along the new direction. search(slope,
/// shortest): makes a step; returns false if no step of `shortest` or more lowers the energy.
template <class Problem, class Checkpoint, class Solve, class Search>
bool search_down(std::shared_ptr<const Problem>& problem, const Coordinates& x,
                 const std::vector<double>& direction, double slope, Checkpoint pass_checkpoint,
                 Solve solve, Search search) {
  constexpr int most_times = 10;
  if (search(slope, shortest_step)) return true;
  for (int i = 0; i < most_times; ++i) {
    pass_checkpoint();
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
