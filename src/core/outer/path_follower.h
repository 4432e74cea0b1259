#pragma once

#include <concepts>

#include "core/outer/outer_solver.h"

namespace winslow {

/// Moves the prescribed nodes of x to their positions at that share of a motion.
using BoundaryMotion = std::function<void(double fraction, Coordinates& x)>;

/// What changes along a path.
struct Path {
  /// A path on which only the boundary changes.
  template <std::invocable<double, Coordinates&> Motion>
  Path(Motion motion) : move(std::move(motion)) {}  // NOLINT: a motion is a path

  BoundaryMotion move;
  /// Switches the solver to the problem at a share of the path; empty if the problem is constant.
  std::function<void(double fraction)> change_problem;
};

/// How a path is followed. The defaults suit most paths.
struct PathOptions {
  double first_step = 0.2;        ///< share of the motion tried first
  double smallest_step = 1e-5;    ///< share of the motion below which the path counts as blocked
  double growth = 1.5;            ///< of the step after an easy one
  int most_corrections = 4;       ///< Newton steps after each prediction
  double loose_tolerance = 0.05;  ///< scaled residual that is near enough to the path on the way
  /// Share of the smallest sine at the start. A mesh with a smaller sine is corrected as long as
  /// that helps: single elements hardly affect the residual.
  double flattened = 0.5;
  /// Share of loose_tolerance after a step that was cut for validity: the distance from the path
  /// would also cut the next step.
  double tightened = 0.3;
  double trusted_residual = 0.3;  ///< of a prediction, above which the step is shortened
  double cautious_step = 2e-3;    ///< share of the motion below which steps are not shortened for a
                                  ///< large residual: see greedy
  /// Whether the path may contain a valid mesh; null: any. Before a refused mesh the steps are
  /// shortened to `finest_step`.
  std::function<bool(const Coordinates&)> admits;
  double finest_step = 1e-3;
  bool greedy = false;  ///< accept any valid mesh after a cautious step, instead of giving up
  /// Number of short steps in a row, with meshes away from the path, after which follow() returns;
  /// 0: never. Away from the path predictions of thin elements are valid for short steps only,
  /// because the Hessian there does not respect rotations.
  int patience = 0;
};

/// Follows the steady mesh while the boundary moves: tangent predictor, exact validity check,
/// Newton corrector, adaptive step. Every accepted mesh is valid.
class PathFollower {
 public:
  /// Receives every accepted intermediate mesh. Returns false to stop.
  using Accept = std::function<bool(IterationRecord, const Coordinates&)>;

  /// The solver outlives the follower.
  PathFollower(SteadySolver& solver, const PathOptions& options)
      : solver_(solver), options_(options) {}

  /// Moves the boundary from x (valid; the boundary at fraction `from` of the motion) towards the
  /// end of the motion, as far as valid meshes are found. Returns the fraction reached; x is the
  /// mesh there, near the path but not converged, and the solver has the problem of that fraction.
  double follow(const Path& path, double from, Coordinates& x, const Accept& accept);

 private:
  struct Goal {
    double fraction;   // of the motion
    bool correct;      // the prediction also corrects x towards the path
    bool may_shorten;  // a trial with a shorter step is possible
    bool cut;          // a longer trial was invalid
    double min_sine;   // of the mesh at the start of the path
  };
  struct Trial {
    bool valid = false;
    double possible = 0;  // share of the prediction that is valid
    int corrections = 0;
    bool trusted = false;  // full Newton steps reached the path
  };
  double go(const Path& path, double from, Coordinates& x, const Accept& accept);
  Trial attempt(const Path& path, const Goal& goal, Coordinates& x, IterationRecord& record);

  SteadySolver& solver_;
  PathOptions options_;
};

}  // namespace winslow
