#pragma once

#include "core/mesh/topology.h"
#include "core/motion/contact.h"
#include "core/outer/outer_solver.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/slide_options.h"

/// What one call of execute() leaves to the next, for programs that change one mesh many times.
/// Bodies that move again and again are the affair of a MovingMesh, which has a cache of its own.
///
///     winslow::SolverCache cache;
///     winslow::RunOptions options;
///     options.cache = &cache;
///     for (int step = 0; step < steps; ++step)
///       state = winslow::execute(bend_wing, state, options).state;
///
/// It keeps the patterns of matrices, their orderings, symbolic factorisations and factors, targets
/// of elements and the virtual control volumes of volume meshes. Every call finds out by itself
/// what of it still holds and makes the rest anew, so that any command, any options and any state
/// may come next. Matrices stay useful as long as two calls share the topology (the same object, as
/// a state and the result made from it do) and the same nodes may move in the same directions. Only
/// the last such pair is kept: two meshes, or two bodies that move in turn, are worth two caches.
///
/// RESULTS are those without a cache, to within the tolerances. Factorisations give the same bits;
/// iterations may not, since the aggregates of a multigrid solver are those of the first matrix,
/// and the solver `automatic` remembers on which mesh iterations were slow. The same calls in the
/// same order give the same bits, at any number of threads.
///
/// MEMORY is what the last call needed beside the mesh; clear() gives it back. The cache also keeps
/// alive the topology and the coordinates that the last call was given.
///
/// THREADS: one call at a time. Calls at once on several threads need a cache each.
///
/// ERRORS: a call that throws, Cancelled included, leaves a cache that can be used again.
namespace winslow {

class SmoothingWorkspace;

/// What is kept from call to call.
class SolverCache {
 public:
  SolverCache();
  ~SolverCache();
  /// What was moved from is as after clear().
  SolverCache(SolverCache&& other) noexcept;
  SolverCache& operator=(SolverCache&& other) noexcept;
  SolverCache(const SolverCache&) = delete;
  SolverCache& operator=(const SolverCache&) = delete;

  /// Forgets everything.
  void clear();

  /// For winslow itself: clients have no definition of the class.
  SmoothingWorkspace& workspace();

 private:
  std::unique_ptr<SmoothingWorkspace> workspace_;  // null: nothing is kept
};

/// What a call of execute() is given besides its command, and what it says:
///
///     winslow::RunOptions options;
///     options.monitor = &monitor;  // told about every iteration; may cancel
///     options.cache = &cache;      // keeps what was prepared for the next call
///     const winslow::SmoothResult smooth = winslow::execute(command, state, options).smooth;
///     if (smooth.fraction_reached < 1) std::puts(winslow::why_incomplete(smooth).c_str());

/// Told about every outer iteration, on the solver's thread.
class SolverMonitor {
 public:
  virtual ~SolverMonitor() = default;
  /// Iterations are of another mesh from here on.
  virtual void on_topology(const std::shared_ptr<const Topology>& /*topology*/) {}
  /// May block (pause). Returns false to cancel: the solver then throws Cancelled.
  virtual bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) = 0;
  /// Asked within outer iterations that take long: true to cancel.
  virtual bool cancelled() { return false; }
};

/// What a run is given besides what it is to do.
struct RunOptions {
  SolverMonitor* monitor = nullptr;
  /// A mesh to start from instead of the state's own (all nodes). For dragging: the solution is the
  /// same, only nearer. Paths begin at its boundary where it is valid; all else uses the interior.
  const Coordinates* start = nullptr;
  /// Prepared solvers, kept from call to call. Null: everything is made for this call.
  SolverCache* cache = nullptr;
  /// A motion along a path that contact is certain to block is not begun: the mesh stays as it is.
  /// Otherwise it goes as far as good meshes lead.
  bool all_or_nothing = false;
  /// Smoothing in place with `auto` targets: where an element ends below the worst of the mesh as
  /// given, elements around it keep their own shapes.
  bool never_worse = false;
  /// What the command has of files: execute() sets it.
  SlideFiles files = {};
  /// Nodes that stay where they are (ascending), of a command with several runs: found once, in the
  /// mesh that it began with. Null: those of SmoothOptions::keep_outside in the mesh of this run.
  const std::vector<Index>* kept = nullptr;
};

/// How a smoothing run ended.
struct RunOutcome {
  bool converged = false;
  double residual = 0;
  bool out_of_iterations = false;  ///< ended by the limit of outer iterations
  double fraction_reached = 1;     ///< share of the boundary motion in the result
  /// The limit that a motion ended before, as QualityFloor::fault() says it; empty: none.
  std::string limited_by;
  /// What blocks a motion along a path, seen before it was begun; of the motion from RunOptions'
  /// start where there is one.
  std::optional<Contact> contact;
  std::optional<Gap> gap;     ///< where a motion is blocked without contact
  int increments = 1;         ///< steps in which the boundary was moved
  Index stuck_nodes = 0;      ///< OuterSolver::stuck_nodes()
  std::string linear_solver;  ///< what solved the linear systems, e.g. "CHOLMOD ..."
  Index inverted = 0;
};

/// What a smoothing run came to.
struct SmoothResult : RunOutcome {
  int outer_iterations = 0;
  int linear_solves = 0;
  /// Part of the elements (0 to 1) that `auto` targets keep stretched; none for other targets.
  std::optional<double> stretched;
  MovingBoundary boundary;  ///< what nodes of the boundary slid on, or were paired by
  Index kept_outside = 0;   ///< interior nodes that SmoothOptions::keep_outside fixed
  std::vector<IterationRecord> history;
};

/// Why a motion was not carried out to its end, as the clause of a sentence: "flap would touch main
/// at 32.4 % of the way".
std::string why_incomplete(const SmoothResult& result);

/// How a boundary motion is carried out.
struct MotionOptions {
  /// Steps in which the boundary moves, each followed by smoothing; 1: at once, as in the paper;
  /// 0: follow the path through valid meshes in steps as long as they can be (fixed-point
  /// iteration: at once; if that ends tangled, again in 8 and then in 32 steps).
  int increments = 0;
  bool smooth_after = true;  ///< false: move the boundary only
  /// The path ends before a mesh that breaks one of these limits. Needs a path to follow:
  /// increments 0, smoothing, and no fixed point.
  QualityFloor floor = {};
};

/// A run has ended valid before its tolerance and its limit of iterations: Newton's method found no
/// way down any more, or one that gains next to nothing (EnergyNewton::stalled()).
bool gains_no_more(const SmoothResult& result);

/// Collects what a smoothing run does: numbers the outer iterations through all of its stages,
/// reports each to the monitor, and fills in the result.
class RunRecorder {
 public:
  /// budget: outer iterations that all stages may take together.
  RunRecorder(SolverMonitor* monitor, SmoothResult& result, int budget)
      : monitor_(monitor), result_(result), budget_(budget) {}

  /// Adds a record. Throws Cancelled if the monitor says so. advance: the record is of an outer
  /// iteration; otherwise it is the assessment of a start.
  void report(IterationRecord record, const Coordinates& x, Stage stage, double fraction,
              bool advance);

  using Enough = std::function<bool(const IterationRecord&)>;
  /// Starts a solver at x and iterates until it has converged, `enough` says so, `limit`
  /// iterations are done, or the budget is spent. Returns the last record; outcome and counts go
  /// into the result.
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          int limit, const Enough& enough = {});
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          const Enough& enough = {}) {
    return iterate(solver, x, stage, fraction, budget_, enough);
  }

  /// Outer iterations left of the budget.
  int remaining() const { return budget_ - result_.outer_iterations; }
  /// From here on stages have their own limits only.
  void lift_budget() { budget_ = std::numeric_limits<int>::max(); }

  SmoothResult& result() { return result_; }
  /// Puts back how an earlier attempt ended; counts and history stay those of all attempts.
  void restore_outcome(const RunOutcome& earlier) { static_cast<RunOutcome&>(result_) = earlier; }

 private:
  SolverMonitor* monitor_;
  SmoothResult& result_;
  int budget_;
};

}  // namespace winslow
