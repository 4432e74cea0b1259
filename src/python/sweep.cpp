#include <future>

#include "core/command/series.h"
#include "core/mesh/mesh.h"
#include "python/edit_run.h"
#include "python/measures.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// Hands the results of a series to Python, one at a time.
class PythonSeries final : public SeriesMonitor {
 public:
  PythonSeries(MeshPointer mesh, py::object take)
      : mesh_(std::move(mesh)), take_(std::move(take)) {}

  bool on_iteration(std::size_t, const IterationRecord&, const Coordinates&) override {
    return !stopped_;
  }
  bool cancelled() override { return stopped_; }

  void on_result(const SeriesResult& result) override {
    const py::gil_scoped_acquire acquired;
    if (stopped_) return;
    try {
      hand_over(result);
      check_signals();
    } catch (const py::error_already_set&) {
      stop(std::current_exception());
    }
  }

  /// Runs work() on another thread, and looks for signals on this one. Throws what either throws.
  template <class Work>
  void run(const Work& work) {
    auto done = std::async(std::launch::async, work);
    {
      const py::gil_scoped_release released;
      while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
        const py::gil_scoped_acquire acquired;
        if (stopped_) continue;
        try {
          check_signals();
        } catch (const py::error_already_set&) {
          stop(std::current_exception());
        }
      }
    }
    try {
      done.get();
    } catch (const Cancelled&) {
      if (!raised_) throw;
    }
    if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
  }

 private:
  static void check_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  void stop(std::exception_ptr raised) {
    raised_ = std::move(raised);
    stopped_ = true;
  }

  void hand_over(const SeriesResult& result) {
    py::dict step;
    step["step"] = result.step;
    step["status"] = std::string(status_name(result.status));
    step["message"] = result.message;
    step["seconds"] = result.seconds;
    step["begins"] = result.begins ? py::object(py::int_(*result.begins)) : py::object(py::none());
    step["mesh"] = py::none();
    if (result.run) {
      const SmoothResult& smooth = result.run->smooth;
      step["mesh"] = result_mesh(*mesh_, result.run->state.mesh, false);
      step["inverted"] = smooth.inverted;
      step["converged"] = smooth.converged;
      step["fraction_reached"] = smooth.fraction_reached;
      step["linear_solves"] = smooth.linear_solves;
    }
    if (take_(step).is(py::bool_(false))) stopped_ = true;
  }

  MeshPointer mesh_;
  py::object take_;
  std::exception_ptr raised_;  // guarded by the GIL
  std::atomic<bool> stopped_ = false;
};

/// All bodies of all steps as one command, to check their names.
MoveCommand all_bodies(const Series& series) {
  MoveCommand command;
  command.bodies.clear();
  command.how = series.how;
  command.smooth = series.smooth;
  std::vector<std::string> seen;
  for (const auto& bodies : series.steps)
    for (const MovingBody& body : bodies)
      for (const std::string& name : body.markers) {
        if (std::ranges::find(seen, name) != seen.end()) continue;
        seen.push_back(name);
        command.bodies.push_back({{name}, body.motion});
      }
  return command;
}

/// The state that the series begins from, and the rest of the series.
MeshState prepare(Series& series, const MeshValue& mesh, const std::vector<std::string>& held,
                  const RunArguments& arguments, std::vector<std::string>& remarks) {
  const std::vector<io::MeshFile> files{mesh.file};
  for (auto& bodies : series.steps) {
    MoveCommand move;
    move.bodies = bodies;
    Command command = move;
    app::expand_groups(command, files);
    bodies = std::get<MoveCommand>(command).bodies;
  }
  app::ZoneRun zone = prepared_zone(mesh, {all_bodies(series)}, arguments, remarks);
  series.smooth = *smooth_options(*zone.commands.front());
  series.files = zone.files.front();
  const std::vector<Command> commands = app::holding_layers(held, series.smooth, SmoothCommand{});
  if (commands.size() > 1) {
    app::check_markers({commands.front()}, mesh.topology(), "the mesh");
    zone.result = execute(commands.front(), zone.result).state;
  }
  return std::move(zone.result);
}

/// steps: list of lists of bodies. take: called with each step, a dict; False ends the series.
/// Returns what the file says of its boundary.
std::vector<std::string> sweep(const MeshPointer& mesh, const py::list& steps, int jobs,
                               const py::object& take, py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, true);
  Series series;
  for (const py::handle step : steps) {
    try {
      series.steps.push_back(bodies_of(step));
    } catch (const UsageError& error) {
      throw UsageError("step " + std::to_string(series.steps.size()) + ": " + error.what());
    }
  }
  if (series.steps.empty()) throw UsageError("steps: found none, expected one or more");
  const auto held = names_of(taken(keywords, "hold_layers"), "hold_layers");
  set_motion(series.how, series.smooth, {}, keywords);
  series.accept_partial = arguments.accept_partial;
  series.jobs = jobs;
  std::vector<std::string> remarks;
  PythonSeries monitor(mesh, take);
  monitor.run([&] {
    const MeshState state = prepare(series, *mesh, held, arguments, remarks);
    run_series(series, state, monitor);
  });
  return remarks;
}

}  // namespace

void bind_sweep(py::module_& module) { module.def("sweep", &sweep); }

}  // namespace winslow::python
