#pragma once

#include <span>

#include "core/mesh/coordinates.h"
#include "core/outer/outer_solver.h"

namespace winslow {

/// An outer solver that can also say, to first order, how its solution answers when the boundary
/// moves: what path following and dragging need.
class SteadySolver : public OuterSolver {
 public:
  /// Moves of the free nodes (#free by 2) that keep the equations satisfied to first order while
  /// the constrained nodes move by `displacement` (#nodes by 2; the free nodes' part is ignored).
  /// Uses the factorisation at hand where there is one for this topology: one linear solve.
  virtual void predict(const Coordinates& x, const Coordinates& displacement,
                       std::span<double> out) = 0;
  /// The same, plus what leads back to the solution where x is only near one: still one linear
  /// solve. Solvers that know no such correction predict.
  virtual void predict_and_correct(const Coordinates& x, const Coordinates& displacement,
                                   std::span<double> out) {
    predict(x, displacement, out);
  }
  /// Forgets the factorisation, so that the next prediction is made at its own coordinates.
  virtual void forget_factorisation() = 0;
};

}  // namespace winslow
