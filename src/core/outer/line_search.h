#pragma once

#include <span>

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

}  // namespace winslow
