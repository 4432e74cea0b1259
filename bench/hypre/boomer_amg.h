#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/linear/linear_solver.h"

namespace winslow::bench {

/// How BoomerAMG sees a matrix of 3 by 3 blocks.
enum class BoomerKind {
  unknown_wise,  ///< three scalar problems that are coupled: the library's default for systems
  nodal          ///< coarsens nodes as a whole
};

/// hypre's conjugate gradients with its algebraic multigrid BoomerAMG (V. E. Henson and U. M. Yang,
/// Applied Numerical Mathematics 41, 2002), in one process, with settings that its manual names for
/// problems of elasticity.
class BoomerAmg {
 public:
  /// Sets up. Throws NumericError if hypre reports an error.
  BoomerAmg(const SparseMatrix& matrix, BoomerKind kind, double tolerance);
  ~BoomerAmg();
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;

  std::string description() const;
  LinearResult solve(std::span<const double> rhs, std::span<double> x);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace winslow::bench
