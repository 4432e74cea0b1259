#pragma once

#include <span>

#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// An outer solver that can also say, to first order, how its solution answers when the boundary
/// moves: what path following and dragging need.
class SteadySolver : public OuterSolver {
 public:
  /// What is solved at present.
  virtual const SmoothingProblem& problem() const = 0;

  /// Change of the unknowns (#unknowns) that keeps the equations satisfied to first order while the
  /// prescribed nodes move by `displacement` (as large as x; what it holds for other nodes is
  /// ignored). One linear solve, with the last linearisation of this problem where there is one,
  /// else with one at x.
  virtual void predict(const Coordinates& x, const Coordinates& displacement,
                       std::span<double> out) = 0;
  /// The same, plus what leads back to the solution where x is only near one: still one linear
  /// solve. Solvers that know no such correction predict.
  virtual void predict_and_correct(const Coordinates& x, const Coordinates& displacement,
                                   std::span<double> out) {
    predict(x, displacement, out);
  }
  /// The caller goes back to a mesh from before the last start(): no linearisation made since is of
  /// a mesh near it, so the next prediction makes its own.
  virtual void reject() = 0;
};

}  // namespace winslow
