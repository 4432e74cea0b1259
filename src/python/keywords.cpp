#include "python/keywords.h"

#include "core/command/option_tables.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// The name of a mesh in messages.
std::string name_of(const MeshValue& mesh) { return mesh.path.empty() ? "the mesh" : mesh.path; }

/// Sets limits of the quality from a dict by the names of metrics.
void set_floor(QualityFloor& floor, const py::object& given) {
  if (given.is_none()) return;
  if (!py::isinstance<py::dict>(given))
    throw UsageError("min_quality: expected a dict of limits by the names of metrics");
  py::dict limits = given.attr("copy")().cast<py::dict>();
  const OptionTable table = option_table(floor);
  OptionTable by_key = table;
  for (Option& option : by_key) option.flag = option.key;
  set_options(by_key, limits);
  if (limits.empty()) return;
  throw UsageError("min_quality: unknown metric \"" +
                   py::str((*limits.begin()).first).cast<std::string>() + "\", expected one of " +
                   listed(table, [](const Option& option) { return option.key; }));
}

/// A body from {"markers": ..., "rotate": ..., ...}.
MovingBody body_of(const py::handle& given, std::size_t number) {
  const std::string where = "bodies[" + std::to_string(number) + "]";
  if (!py::isinstance<py::dict>(given))
    throw UsageError(where + ": expected a dict with markers, rotate, translate, pivot or axis");
  py::dict keywords = given.attr("copy")().cast<py::dict>();
  MovingBody body;
  body.markers = names_of(taken(keywords, "markers"), where + " markers");
  if (body.markers.empty()) throw UsageError(where + ": expected \"markers\", what moves");
  if (!keywords.contains("rotate") && !keywords.contains("translate"))
    throw UsageError(where + ": nothing to do: expected rotate, translate, or both");
  const OptionTable table = option_table(body.motion);
  try {
    set_options(table, keywords);
    refuse_others(keywords, known_keywords(table));
  } catch (const UsageError& error) {
    throw UsageError(where + ": " + error.what());
  }
  return body;
}

}  // namespace

RunArguments run_arguments(py::dict& keywords, bool motion) {
  RunArguments arguments;
  arguments.progress = taken(keywords, "progress");
  if (!arguments.progress.is_none() && PyCallable_Check(arguments.progress.ptr()) == 0)
    throw UsageError("progress: expected a function of one argument, the iteration");
  take(keywords, "config", arguments.config, "the name of a file");
  if (!motion) return arguments;
  take(keywords, "reference", arguments.reference, "a mesh");
  take(keywords, "allow_incomplete", arguments.accept_partial, "True or False");
  return arguments;
}

std::vector<std::string> known_keywords(const OptionTable& table,
                                        std::initializer_list<const char*> more) {
  std::vector<std::string> names(more.begin(), more.end());
  for (const Option& option : table) names.push_back(keyword_of(option));
  return names;
}

OptionTable motion_table(MotionOptions& how) {
  OptionTable table = option_table(how);
  std::erase_if(table, [](const Option& option) { return option.object == "min_quality"; });
  return table;
}

void set_motion(MotionOptions& how, SmoothOptions& smooth, const OptionTable& more,
                py::dict& keywords) {
  set_floor(how.floor, taken(keywords, "min_quality"));
  const OptionTable table = joined(joined(more, motion_table(how)), option_table(smooth));
  set_options(table, keywords);
  refuse_others(keywords,
                known_keywords(table, {"reference", "config", "progress", "allow_incomplete",
                                       "allow_inverted", "min_quality", "hold_layers"}));
}

std::vector<MovingBody> bodies_of(const py::handle& given) {
  std::vector<MovingBody> bodies;
  for (const py::handle body : given) bodies.push_back(body_of(body, bodies.size()));
  if (bodies.empty()) throw UsageError("bodies: found an empty list, expected one body or more");
  return bodies;
}

SineDeformation sine_of(const py::object& given) {
  SineDeformation shape;
  py::dict settings = given.attr("copy")().cast<py::dict>();
  for (const char* name : {"amplitude", "waves"})
    if (!settings.contains(name))
      throw UsageError(std::string("sine: expected a number \"") + name + '"');
  const OptionTable table = option_table(shape);
  set_options(table, settings);
  refuse_others(settings, known_keywords(table));
  return shape;
}

app::ZoneRun prepared_zone(const MeshValue& mesh, std::vector<Command> commands,
                           const RunArguments& arguments, std::vector<std::string>& remarks) {
  if (mesh.file.defective)
    throw UsageError(name_of(mesh) +
                     " is no sound mesh, read to be shown: read it with repair=True");
  for (const Command& command : commands)
    if (const SmoothOptions* options = smooth_options(command)) validate(*options);
  std::vector<io::MeshFile> files{mesh.file};
  for (Command& command : commands) app::expand_groups(command, files);
  std::vector<app::ZoneRun> zones = app::share_out(std::move(files), commands, name_of(mesh));
  remarks = app::add_file_defaults(zones, arguments.config);
  app::resolve_files(zones, io::read_reference);
  app::ZoneRun zone = std::move(zones.front());
  zone.result = make_state(zone.source.mesh);
  if (arguments.reference) {
    zone.result = with_reference(std::move(zone.result), arguments.reference->mesh());
    zone.source.mesh.topology = zone.result.mesh.topology;
  }
  return zone;
}

}  // namespace winslow::python
