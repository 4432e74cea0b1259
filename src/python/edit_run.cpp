#include "python/edit_run.h"

#include <nlohmann/json.hpp>

#include "app/job/held_motion.h"
#include "app/job/run_messages.h"
#include "core/error.h"
#include "python/errors.h"
#include "python/monitor.h"

namespace py = pybind11;

namespace winslow::python {
EditRun::EditRun(std::string name, MeshPointer source, std::vector<Command> commands,
                 const RunArguments& arguments)
    : source_(std::move(source)) {
  report_.command = std::move(name);
  report_.input = source_->path;
  PythonMonitor monitor(arguments.progress);
  monitor.run([&] {
    zone_ = prepared_zone(*source_, std::move(commands), arguments, remarks_);
    RunOptions options;
    options.monitor = &monitor;
    options.all_or_nothing = !arguments.accept_partial;
    for (std::size_t k = 0; k < zone_.commands.size(); ++k) {
      const MeshState* const states[] = {&zone_.result};
      const ResolvedCommand command(with_pivot(*zone_.commands[k], states), zone_.files[k]);
      zone_.commands[k] = command.command();
      CommandResult result = execute(command, zone_.result, options);
      report_.commands.push_back(
          app::make_record(command.command(), std::move(result.smooth), result.state.mesh));
      zone_.result = std::move(result.state);
    }
    warn();
  });
  // Layers alone change the connectivity; polygons may have that of the reference mesh.
  result_ = result_mesh(*source_, zone_.result.mesh,
                        zone_.result.mesh.topology != zone_.source.mesh.topology);
  zone_.result.vcvs = {};  // as large as the mesh, and of no use for reports
}

void EditRun::warn() {
  const auto add = [&](const std::string& text) {
    if (!text.empty()) report_.warnings.push_back(in_words_of_python(text));
  };
  add(app::damage_warning(zone_));
  if (is_surface(*zone_.result.mesh.topology)) {
    app::measure(zone_, {});
    measured_ = true;
    add(app::fold_warning(zone_));
  }
  if (const auto held = app::find_held_motion(zone_))
    add(app::describe(*held, app::moving_markers(zone_)));
}

double EditRun::fraction_reached() const {
  double fraction = 1;
  for (const app::CommandRecord& command : report_.commands)
    fraction = std::min(fraction, command.result.fraction_reached);
  return fraction;
}

int EditRun::linear_solves() const {
  int solves = 0;
  for (const app::CommandRecord& command : report_.commands) solves += command.result.linear_solves;
  return solves;
}

std::string EditRun::why_incomplete() const {
  for (const app::CommandRecord& command : report_.commands) {
    const SmoothResult& result = command.result;
    if (result.fraction_reached < 1 || !result.limited_by.empty())
      return in_words_of_python(winslow::why_incomplete(result));
  }
  return {};
}

std::vector<IterationRecord> EditRun::history() const {
  std::vector<IterationRecord> all;
  for (const app::CommandRecord& command : report_.commands)
    all.insert(all.end(), command.result.history.begin(), command.result.history.end());
  return all;
}

std::string EditRun::report() {
  const py::gil_scoped_release released;
  const std::lock_guard lock(measuring_);
  if (!std::exchange(measured_, true)) app::measure(zone_, {});
  return app::make_report({zone_}, report_).dump();
}

}  // namespace winslow::python
