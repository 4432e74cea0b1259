#pragma once

#include "core/mesh/topology.h"
#include "core/motion/contact.h"
#include "core/motion/held_elements.h"
#include "core/outer/outer_solver.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/slide_options.h"

/// Keeps prepared solvers between calls of execute(), for programs that change one mesh many times.
/// For a boundary that moves repeatedly use a Deformer, which has its own cache.
///
///     winslow::SolverCache cache;
///     winslow::RunOptions options;
///     options.cache = &cache;
///     for (int step = 0; step < steps; ++step)
///       state = winslow::execute(bend_wing, state, options).state;
///
/// It keeps the patterns of matrices, their orderings, symbolic factorisations and factors, targets
/// of elements and the virtual control volumes of volume meshes. Every call checks which parts are
/// still valid and remakes the rest, so any command, options and state may come next. Matrices are
/// reused if two calls share the topology (the same object, as a state and its result do) and the
/// same nodes may move in the same directions. Only the last such pair is kept: use two caches for
/// two meshes, or for two bodies that move alternately.
///
/// RESULTS equal those without a cache to within the tolerances. With direct solvers they are the
/// same bits. With iterative solvers they may differ: a multigrid solver keeps the aggregates of
/// the first matrix, and the solver `automatic` remembers on which mesh iterations were slow. The
/// same calls in the same order give the same bits, at any number of threads.
///
/// MEMORY: the cache holds what the last call needed besides the mesh; clear() frees it. The cache
/// also keeps the topology and the coordinates of the last call alive.
///
/// THREADS: one call at a time. Calls at once on several threads need a cache each.
///
/// ERRORS: after a call that throws, Cancelled included, the cache remains usable.
namespace winslow {

class SmoothingWorkspace;

/// Prepared solvers, kept from call to call.
class SolverCache {
 public:
  SolverCache();
  ~SolverCache();
  /// A moved-from cache is as after clear().
  SolverCache(SolverCache&& other) noexcept;
  SolverCache& operator=(SolverCache&& other) noexcept;
  SolverCache(const SolverCache&) = delete;
  SolverCache& operator=(const SolverCache&) = delete;

  /// Forgets everything.
  void clear();
  /// Forgets the linear solvers, with what iterative ones remember of earlier matrices. The next
  /// results are then the same bits whatever calls came before.
  void forget_matrices();

  /// For winslow itself: clients have no definition of the class.
  SmoothingWorkspace& workspace();

 private:
  std::unique_ptr<SmoothingWorkspace> workspace_;  // null: nothing is kept
};

/// Further inputs of execute(), and how its result is reported:
///
///     winslow::RunOptions options;
///     options.monitor = &monitor;  // told about every iteration; may cancel
///     options.cache = &cache;      // keeps what was prepared for the next call
///     const winslow::SmoothResult smooth = winslow::execute(command, state, options).smooth;
///     if (smooth.fraction_reached < 1) std::puts(winslow::why_incomplete(smooth).c_str());

/// Receives every outer iteration, on the solver's thread.
class SolverMonitor {
 public:
  virtual ~SolverMonitor() = default;
  /// Later iterations are of another mesh.
  virtual void on_topology(const std::shared_ptr<const Topology>& /*topology*/) {}
  /// May block (pause). Returns false to cancel: the solver then throws Cancelled.
  virtual bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) = 0;
  /// Asked within outer iterations that take long: true to cancel.
  virtual bool cancelled() { return false; }
};

/// The nodes of the bodies of a motion, ascending.
struct BodyNodes {
  std::vector<Index> all;
  /// Those that the boundary under them gives way to: all that change their places.
  std::vector<Index> standing;
};

/// What else is known of the start of a motion, for a Deformer and a Series.
struct NearStart {
  /// How the bodies get from the start to the end of the motion: along the arcs of these motions,
  /// which refer to the mesh of the start and have pivots. Empty: the shortest way.
  std::vector<MovingBody> way = {};
  /// Earlier results of the same motion at other ends, the latest first. If the result can be
  /// predicted from these meshes and the start (NewtonRun::start_near()), no path is followed.
  std::vector<std::shared_ptr<const Coordinates>> earlier = {};
  /// The result has to be that of the run without a start: a motion that contact blocks on its way
  /// from the state's mesh is not begun, and the start is left aside if contact blocks one of the
  /// motions `beside`, which go from the state's mesh to places between the start and the end. So
  /// no body lies between the way of the start and that of the motion.
  bool as_without = false;
  /// If the result is not near enough to be predicted, the start is left aside.
  bool only_near = false;
  std::vector<std::vector<MovingBody>> beside = {};
};

/// Inputs of a run besides its command.
struct RunOptions {
  SolverMonitor* monitor = nullptr;
  /// A mesh to start from instead of the state's own (all nodes). For dragging: the solution is the
  /// same, but this start is nearer to it. If it is valid, paths begin at its boundary; all other
  /// methods use only its interior. Without a tolerance of its own the command is solved to 1e-10,
  /// in volume meshes too, so that the start is not seen in the result.
  const Coordinates* start = nullptr;
  /// Prepared solvers, kept from call to call. Null: nothing is reused.
  SolverCache* cache = nullptr;
  /// If true, a motion along a path that contact is certain to block is not begun: the mesh stays
  /// as it is. If false, the motion proceeds as far as admissible meshes exist.
  bool all_or_nothing = false;
  /// For smoothing in place with `auto` targets: if an element ends worse than the worst element of
  /// the mesh as given, the elements around it keep their own shapes.
  bool never_worse = false;
  /// Contents of the files that the command names: set by execute().
  SlideFiles files = {};
  /// Bodies to which the boundary that they stand on gives way (let_footholds_slide()): set by
  /// commands that move bodies, and by drags. Null: nothing gives way.
  const BodyNodes* bodies = nullptr;
  /// Fixed nodes (ascending), for a command with several runs: determined once, in the initial
  /// mesh. Null: those of SmoothOptions::keep_outside in the mesh of this run.
  const std::vector<Index>* kept = nullptr;
  /// Factors of the heights of layers in the targets (WallStretch::find()), for a run that corrects
  /// heights. Null: none.
  const std::vector<double>* layer_factors = nullptr;
  /// Coordinates in which elements with the role of layers have the shapes that are their targets
  /// (VolumeTargetDetails::layer_shapes), for smoothing in place that opens the layers of a volume
  /// mesh. Null: they have targets like others.
  std::shared_ptr<const Coordinates> layer_shapes = nullptr;
  NearStart near = {};  ///< used together with `start`
};

/// How a smoothing run ended.
struct RunOutcome {
  bool converged = false;
  bool nothing_moves = false;  ///< a motion that moves no node: the mesh is as it was given
  double residual = 0;
  bool out_of_iterations = false;  ///< ended by the limit of outer iterations
  double fraction_reached = 1;     ///< share of the boundary motion in the result
  /// The quality limit that ended the motion, in the words of QualityFloor::fault(); empty: none.
  std::string limited_by;
  /// The contact that blocks a motion along a path, detected before the motion began. If RunOptions
  /// has a start, it concerns the motion from there.
  std::optional<Contact> contact;
  std::optional<Gap> gap;  ///< at which a motion is blocked without contact
  /// An element without free nodes that the motion inverts, and that therefore blocks it.
  std::optional<HeldInversion> held_inversion;
  int increments = 1;         ///< number of steps of the boundary motion
  Index stuck_nodes = 0;      ///< OuterSolver::stuck_nodes()
  std::string linear_solver;  ///< description of the linear solver, e.g. "CHOLMOD ..."
  Index inverted = 0;
};

/// How well a motion held the heights of layers (held_walls.h).
struct LayersHeld {
  Index heights = 0;  ///< number of them: edges up the columns of layers
  double error = 0;   ///< largest |height / height in the reference mesh - 1|
  /// The factors of the heights in the targets of the result (WallStretch::find()): corrections,
  /// by the upper node of each edge (#nodes; 0: no height is held there). RunOptions::layer_factors
  /// with these repeats the run without corrections.
  std::vector<double> factors = {};
};

/// Internal faces of a volume mesh with polyhedra that lean by more than checkMesh of OpenFOAM
/// allows (70 degrees), and did not in the reference mesh (face_angles.h).
struct FaceAngles {
  Index beyond = 0;  ///< number of them in the result
  Index mended = 0;  ///< of those of the solution, how many fewer the result has
  double worst = 0;  ///< largest of their angles, degrees; 0: there are none
};

/// The result of a smoothing run.
struct SmoothResult : RunOutcome {
  int outer_iterations = 0;
  int linear_solves = 0;
  /// Fraction of the elements (0 to 1) that `auto` targets keep stretched; none for other targets.
  std::optional<double> stretched;
  Index without_shape = 0;      ///< elements that had no shape for `keep` targets: made regular
  MovingBoundary boundary;      ///< how nodes of the boundary slid or were paired
  Index kept_outside = 0;       ///< interior nodes that SmoothOptions::keep_outside fixed
  Index prescribed_inside = 0;  ///< interior nodes that the motion takes
  std::optional<FaceAngles> face_angles;  ///< after a motion; none: the mesh has no polyhedra
  std::optional<LayersHeld> layers_held;  ///< at held walls of a volume mesh; none: no walls held
  std::vector<IterationRecord> history;
  /// Memory at the end of the stage of the run that took the most.
  MemoryUse memory;
};

/// Why a motion was not completed, as a clause: "flap would touch main at 32.4 % of the way".
std::string why_incomplete(const SmoothResult& result);

/// How a boundary motion is carried out.
struct MotionOptions {
  /// Number of steps of the boundary, each followed by smoothing. 1: a single step, as in the
  /// paper. 0: follow the path of valid meshes with adaptive steps (fixed-point iteration: a single
  /// step; if the result is tangled, again in 8 and then in 32 steps).
  int increments = 0;
  bool smooth_after = true;  ///< false: move the boundary only
  /// The path ends before a mesh that violates one of these limits. Requires a path: increments 0,
  /// smoothing, and no fixed point.
  QualityFloor floor = {};
};

/// True if a run ended with a valid mesh before reaching its tolerance or its iteration limit:
/// Newton's method found no further descent, or a negligible one (EnergyNewton::stalled()).
bool gains_no_more(const SmoothResult& result);

/// Records a smoothing run: numbers the outer iterations consecutively over all stages, reports
/// each to the monitor, and fills in the result.
class RunRecorder {
 public:
  /// budget: outer iterations that all stages may take together.
  RunRecorder(SolverMonitor* monitor, SmoothResult& result, int budget)
      : monitor_(monitor), result_(result), budget_(budget) {}

  /// Adds a record. Throws Cancelled if the monitor says so. advance: true for an outer iteration,
  /// false for the assessment of a start.
  void report(IterationRecord record, const Coordinates& x, Stage stage, double fraction,
              bool advance);

  using Enough = std::function<bool(const IterationRecord&)>;
  /// Starts a solver at x and iterates until it has converged (see interior_is_behind()), `enough`
  /// says so, `limit` iterations are done, or the budget is spent. Returns the last record; outcome
  /// and counts go into the result.
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          int limit, const Enough& enough = {});
  IterationRecord iterate(OuterSolver& solver, Coordinates& x, Stage stage, double fraction,
                          const Enough& enough = {}) {
    return iterate(solver, x, stage, fraction, budget_, enough);
  }

  /// Tells that the boundary of the next mesh has moved and its interior has not. Iterations then
  /// end no earlier than at a hundredth of the residual that this causes: that of a small motion
  /// may be below the tolerance, and the interior would stay behind. Down to 1e-10, and as long as
  /// every iteration lowers the residual.
  void interior_is_behind() { interior_is_behind_ = true; }

  /// Sets a function that adds the memory of what all stages share. Without one no memory is
  /// counted.
  void count_memory(std::function<void(MemoryUse&)> shared) { shared_ = std::move(shared); }

  /// Outer iterations left of the budget.
  int remaining() const { return budget_ - result_.outer_iterations; }
  /// Removes the common budget: later stages have only their own limits.
  void lift_budget() { budget_ = std::numeric_limits<int>::max(); }

  SmoothResult& result() { return result_; }
  /// Restores the outcome of an earlier attempt; counts and history still cover all attempts.
  void restore_outcome(const RunOutcome& earlier) { static_cast<RunOutcome&>(result_) = earlier; }

 private:
  void note_memory(const OuterSolver& solver);

  SolverMonitor* monitor_;
  SmoothResult& result_;
  int budget_;
  bool interior_is_behind_ = false;
  double caught_up_ = std::numeric_limits<double>::infinity();  // residual at which it no longer is
  std::function<void(MemoryUse&)> shared_;
};

}  // namespace winslow
