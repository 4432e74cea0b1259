#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Equations that can be linearised by freezing their coefficients: what a fixed-point iteration
/// needs.
class FixedPointProblem : public SmoothingProblem {
 public:
  /// Linear system A delta = R of the fixed-point iteration with frozen coefficients: the step to
  /// the solution of the equations linearised by freezing. The numbers of its right-hand sides are
  /// the unknowns, in their order. Returns the number of negative weights met.
  virtual Index freeze(const Coordinates& x, SparseSystem& out) const = 0;
};

/// Equations without an energy, for Newton's method: what lies downhill is told by a merit
/// function.
class EquationProblem : public FixedPointProblem {
 public:
  /// Newton's system J delta = S R, S a scaling of the rows that counts as constant. Returns the
  /// norms of R as residual() does.
  virtual ResidualNorms linearise(const Coordinates& x, SparseMatrix& jacobian,
                                  std::span<double> residual) const = 0;
  /// What the merit function weighs residuals by, as it is at x; held while a step is searched for
  /// (only then is the Newton direction one of descent).
  virtual std::vector<double> merit_weights(const Coordinates& x) const = 0;
  /// Sum of the squares of the scaled residuals.
  virtual double merit(const Coordinates& x, std::span<const double> weights) const = 0;
};

/// Equations as they are, and with the negative weights of their rows set to zero: then every row
/// is a convex combination, which untangles. May be one and the same.
template <typename Problem>
struct ClipVariants {
  std::shared_ptr<const Problem> plain, clipped;

  const std::shared_ptr<const Problem>& of(bool clip) const { return clip ? clipped : plain; }
};

}  // namespace winslow
