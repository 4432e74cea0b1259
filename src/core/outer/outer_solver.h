#pragma once

#include <functional>
#include <utility>

#include "core/mesh/coordinates.h"
#include "core/problem/smoothing_problem.h"
#include "core/types.h"

/// The convergence of a run, iteration by iteration:
///
///     for (const winslow::IterationRecord& record : result.smooth.history)
///       std::printf("%d %.3e\n", record.iteration, record.residual);
namespace winslow {

/// The stage of a run to which an outer iteration belongs.
enum class Stage {
  picard,    ///< fixed-point iteration
  untangle,  ///< towards a mesh without inverted elements
  relax,     ///< approaching a solution before the path or the last steps
  descent,   ///< first-order steps towards a solution
  path,      ///< following the boundary's motion
  newton,    ///< Newton's method towards the tolerance
  worst      ///< raising the worst element of a solution
};
/// "picard", "untangle", ...
inline std::string_view stage_name(Stage stage) {
  constexpr std::array<std::string_view, 7> names{"picard", "untangle", "relax", "descent",
                                                  "path",   "newton",   "worst"};
  return names[static_cast<std::size_t>(stage)];
}

/// One row of a convergence history. Iteration 0 is the mesh as given.
struct IterationRecord {
  int iteration = 0;
  double residual = 0;      ///< ResidualNorms::max after the iteration
  double largest_move = 0;  ///< of any node, in units of the mesh
  Index inverted = 0;       ///< elements
  double min_sine = 0;      ///< smallest normalized Jacobian
  double damping = 0;       ///< as used
  bool clipped = false;     ///< negative weights were set to zero
  int linear_iterations = 0;
  double fraction = 1;  ///< share of the boundary motion applied so far
  Stage stage = Stage::picard;
};

/// Drives a problem towards a solution, one outer iteration at a time.
class OuterSolver {
 public:
  virtual ~OuterSolver() = default;
  /// Assesses coordinates without changing them (iteration 0), e.g. after the boundary moved.
  virtual IterationRecord start(const Coordinates& x) = 0;
  /// One outer iteration.
  virtual IterationRecord step(Coordinates& x) = 0;
  /// True if the last record meets the tolerance, also on a mesh whose solution is tangled.
  virtual bool converged() const = 0;
  /// True if the last step made no progress and further steps would not either.
  virtual bool stalled() const { return false; }
  /// Number of nodes held at folds of their curve or surface
  /// (EnergyProblem::holding_stuck_nodes()).
  virtual Index stuck_nodes() const { return 0; }
  /// Adds the memory that it keeps from iteration to iteration, without its problem and without
  /// solvers that it shares.
  virtual void count(MemoryUse& /*use*/) const {}
  /// Linear systems solved since the solver was made.
  int linear_solves() const { return linear_solves_; }

  /// Sets a function that a step with many linear solves calls between them. An exception from it
  /// ends the step and the iteration. Empty: none.
  void set_checkpoint(std::function<void()> checkpoint) { checkpoint_ = std::move(checkpoint); }

 protected:
  void pass_checkpoint() const {
    if (checkpoint_) checkpoint_();
  }
  /// Begins a history.
  void begin_record(double damping) {
    record_ = {};
    record_.damping = damping;
  }
  void record(const Validity& validity) {
    record_.inverted = validity.inverted;
    record_.min_sine = validity.min_sine;
  }

  IterationRecord record_;  // the last one
  int linear_solves_ = 0;

 private:
  std::function<void()> checkpoint_;
};

/// Whether negative weights of the operator are set to zero.
enum class Clip {
  automatic,  ///< while the mesh is tangled
  on,
  off
};

/// How equations without an energy are solved.
struct EquationOptions {
  Clip clip = Clip::automatic;
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  double damping = 0.3;      ///< share of the step to the solution with frozen coefficients, (0, 1]
  bool adapt_damping = true;  ///< halve the damping where the iteration makes no progress
  /// Earlier iterates that Anderson acceleration combines once the mesh is valid; 0: none.
  int acceleration = 15;
};

/// An outer solver that can also predict, to first order, the change of its solution when the
/// boundary moves, for path following and dragging.
class SteadySolver : public OuterSolver {
 public:
  /// The problem that is solved at present.
  virtual const SmoothingProblem& problem() const = 0;

  /// Change of the unknowns (#unknowns) that keeps the equations satisfied to first order while the
  /// prescribed nodes move by `displacement` (as large as x; entries of other nodes are ignored).
  /// One linear solve, with the last linearisation of this problem if there is one, otherwise with
  /// one at x.
  void predict(const Coordinates& x, const Coordinates& displacement, std::span<double> out) {
    respond(x, displacement, false, out);
  }
  /// The same, plus a correction towards the solution if x is only near one: still one linear
  /// solve. Solvers without such a correction only predict.
  void predict_and_correct(const Coordinates& x, const Coordinates& displacement,
                           std::span<double> out) {
    respond(x, displacement, true, out);
  }
  /// Tells the solver that the caller returns to a mesh from before the last start(): later
  /// linearisations do not apply near it, so the next prediction makes its own.
  virtual void reject() = 0;

 protected:
  virtual void respond(const Coordinates& x, const Coordinates& displacement, bool correct,
                       std::span<double> out) = 0;
};

}  // namespace winslow
