#pragma once

#include "core/command/command.h"

/// Many motions of one mesh, as for a table of flap angles:
///
///     winslow::Series series;
///     for (double angle = -30; angle <= 10; angle += 2)
///       series.steps.push_back({{{"flap"}, {.rotate = angle, .pivot = winslow::Vec2(0.8, 0)}}});
///     winslow::run_series(series, state, [](const winslow::SeriesResult& step) {
///       if (step.status == winslow::SeriesStatus::done) std::printf("%zu\n", step.step);
///     });
///
/// RESULTS: Every step is a motion of the mesh as given, as by a MoveCommand of its own: its mesh
/// is that of the single run to the solver's tolerance. It depends neither on the other steps nor
/// on their order. A step that fails does not end the others.
///
/// WORK: Steps begin from the mesh of their nearest neighbour: nearest in motion, along a minimum
/// spanning tree that goes out from the mesh as given (R. C. Prim, Bell Syst. Tech. J. 36, 1957).
/// Meshes of neighbours predict the next one, so that a step of two degrees needs two or three
/// linear solves. A step begins from the mesh as given where its result might depend on the
/// beginning, or where no path leads from the neighbour: starts_at_neighbours(). So it does where a
/// body turns by more than 180 degrees, or the smallest sine falls below a tenth of that of the
/// mesh as given: meshes that are strained so much may be one of several solutions.
///
/// THREADS: jobs at once, each on one thread; a single job uses SmoothOptions::threads. Results do
/// not depend on either, to the bit.
namespace winslow {

/// Steps of one mesh and how all of them are carried out.
struct Series {
  std::vector<std::vector<MovingBody>> steps;  ///< the bodies of a step move together
  MotionOptions how;
  SmoothOptions smooth;
  SlideFiles files = {};        ///< what the options name: io::resolve_files()
  bool accept_partial = false;  ///< go as far as possible: RunOptions::all_or_nothing
  int jobs = 1;                 ///< steps at once; 0: one for each core
};

/// How a step ended.
enum class SeriesStatus {
  done,           ///< converged, valid, at the end of the motion
  not_converged,  ///< valid, at the end of the motion, but not converged
  incomplete,     ///< the motion could not be completed: why_incomplete()
  inverted,       ///< the mesh has inverted elements
  failed          ///< the run threw an error
};
/// "done", "not converged", ...
std::string_view status_name(SeriesStatus status);

/// The result of one step.
struct SeriesResult {
  std::size_t step = 0;  ///< index into Series::steps
  SeriesStatus status = SeriesStatus::failed;
  std::string message;               ///< why it is not done, one sentence; empty: it is done
  std::vector<MovingBody> bodies;    ///< of the step, with pivots
  std::optional<CommandResult> run;  ///< none: failed. Counts cover all attempts
  std::optional<std::size_t>
      begins;          ///< the step from whose mesh it began; none: the mesh as given
  double seconds = 0;  ///< wall-clock time of the step
};

/// Receives the results of a series. With several jobs, members are called on several threads at
/// once, but only on one of them for each step.
class SeriesMonitor {
 public:
  virtual ~SeriesMonitor() = default;
  /// A step begins.
  virtual void on_begin(std::size_t /*step*/) {}
  /// As SolverMonitor::on_iteration(). Returns false to cancel the series.
  virtual bool on_iteration(std::size_t /*step*/, const IterationRecord& /*record*/,
                            const Coordinates& /*x*/) {
    return true;
  }
  /// Asked within iterations that take long: true to cancel the series.
  virtual bool cancelled() { return false; }
  /// Once for each step, as soon as it has ended. Neighbours come one after another, not in the
  /// order of the steps. An exception ends the series.
  virtual void on_result(const SeriesResult& result) = 0;
};

/// Carries out all steps. Returns the status of each. state: the reference is that of the state.
/// Throws UsageError, before anything is solved, for options that are out of range and for a step
/// that is no motion of this mesh: "step 3: ...". Throws Cancelled, and what the monitor throws.
std::vector<SeriesStatus> run_series(const Series& series, const MeshState& state,
                                     SeriesMonitor& monitor);
/// The same with a function that gets each result, one at a time.
std::vector<SeriesStatus> run_series(const Series& series, const MeshState& state,
                                     const std::function<void(const SeriesResult&)>& on_result);

/// Throws UsageError as run_series() does before anything is solved.
void check_series(const Series& series, const MeshState& state);

/// Whether steps may begin from a neighbour's mesh. Not with limits of the quality, which hold on
/// the whole way; with a fixed number of increments, the pointwise form, `raise_worst` or held
/// layers, whose results depend on the beginning; with other targets than `keep`, whose penalty may
/// depend on the way; with a reference surface, at whose edges several meshes may be solutions; and
/// not if the mesh as given has inverted elements.
bool starts_at_neighbours(const Series& series, const MeshState& state);

}  // namespace winslow
