#pragma once

#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"
#include "core/strategy/run_recorder.h"

namespace winslow {

/// Moves the boundary of x and smooths by the paper's outer iteration. increments: steps in which
/// the boundary moves; 0: at once and, where that ends tangled, in more and more steps; where no
/// way leads to a valid mesh, the result is that of the direct way, converged or not. rest: what
/// the motion refers to.
void move_by_fixed_point(const Coordinates& rest, const Motion& motion, int increments,
                         int max_iterations, OuterSolver& solver, RunRecorder& recorder,
                         Coordinates& x);

}  // namespace winslow
