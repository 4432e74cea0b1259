#include "core/command/option_tables.h"
#include "io/recipe/recipe.h"
#include "io/tables/table_files.h"
#include "python/arrays.h"
#include "python/edit_run.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// The options of a command that its function takes as keywords, but for those that have arguments
/// of their own.
OptionTable keyword_table(SmoothCommand& command) { return option_table(command.smooth); }
OptionTable keyword_table(ScrambleCommand& command) { return option_table(command); }
OptionTable keyword_table(LayersCommand& command) {
  return joined(option_table(command), option_table(command.smooth));
}

/// Sets the options from what is left of the keywords. Throws UsageError for others.
template <class AnyCommand>
void set_keywords(AnyCommand& command, py::dict& keywords) {
  const OptionTable table = keyword_table(command);
  set_options(table, keywords);
  refuse_others(keywords, known_keywords(table, {"config", "progress", "allow_inverted"}));
}

std::shared_ptr<EditRun> run(const char* name, const MeshPointer& mesh,
                             std::vector<Command> commands, const RunArguments& arguments) {
  return std::make_shared<EditRun>(name, mesh, std::move(commands), arguments);
}

std::shared_ptr<EditRun> smooth(const MeshPointer& mesh, py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, false);
  SmoothCommand command;
  set_keywords(command, keywords);
  return run("smooth", mesh, {command}, arguments);
}

std::shared_ptr<EditRun> scramble(const MeshPointer& mesh, py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, false);
  ScrambleCommand command;
  set_keywords(command, keywords);
  return run("scramble", mesh, {command}, arguments);
}

constexpr const char* nothing_to_do = "nothing to do: give rotate, translate, or both";

std::shared_ptr<EditRun> move(const MeshPointer& mesh, const py::object& markers,
                              const py::object& bodies, py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, true);
  MoveCommand command;
  if (!bodies.is_none()) {
    if (!markers.is_none())
      throw UsageError("found bodies together with markers, which are of a single body");
    command.bodies = bodies_of(bodies);
  } else {
    command.bodies.front().markers = names_of(markers, "markers");
    if (command.bodies.front().markers.empty())
      throw UsageError("nothing to move: give markers, or bodies with a motion each");
    if (keywords.empty()) throw UsageError(nothing_to_do);
  }
  const bool motion =
      !bodies.is_none() || keywords.contains("rotate") || keywords.contains("translate");
  OptionTable own;
  RigidMotion single;
  if (bodies.is_none()) own = option_table(single);
  const auto held = names_of(taken(keywords, "hold_layers"), "hold_layers");
  set_motion(command.how, command.smooth, own, keywords);
  if (!motion) throw UsageError(nothing_to_do);
  if (bodies.is_none()) command.bodies.front().motion = single;
  return run("move", mesh, app::holding_layers(held, command.smooth, command), arguments);
}

/// Rows of numbers for the nodes `ids`, as entries of a table.
template <class Entry, class Set>
std::vector<Entry> entries_of(const py::object& ids, const py::object& numbers, int dimension,
                              const char* what, const Set& set) {
  const auto nodes = InputArray<Index>::ensure(ids);
  if (!nodes || nodes.ndim() != 1) {
    PyErr_Clear();
    throw UsageError("nodes: expected an array of ids of nodes");
  }
  const Coordinates rows =
      coordinates_of(numbers, dimension, static_cast<Index>(nodes.size()), what);
  std::vector<Entry> entries(static_cast<std::size_t>(nodes.size()));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    entries[k].node = nodes.data()[k];
    set(entries[k], GivenVector::of(dimension, place_of(rows, static_cast<Index>(k))));
  }
  return entries;
}

/// nodes, numbers: what foreign.py made of the arguments, or a file.
void set_shape(DeformCommand& command, const std::string& kind, const py::object& nodes,
               const py::object& numbers, int dimension) {
  if (kind == "displacements" && nodes.is_none()) {
    command.shape = io::read_displacements(py::str(numbers).cast<std::string>());
  } else if (kind == "positions" && nodes.is_none()) {
    command.shape = io::read_positions(py::str(numbers).cast<std::string>());
  } else if (kind == "displacements") {
    DisplacementTable table;
    table.source = "displacements";
    table.entries = entries_of<DisplacementEntry>(
        nodes, numbers, dimension, "displacements",
        [](DisplacementEntry& entry, const GivenVector& v) { entry.displacement = v; });
    command.shape = std::move(table);
  } else {
    PositionTable table;
    table.source = "positions";
    table.entries = entries_of<PositionEntry>(
        nodes, numbers, dimension, "positions",
        [](PositionEntry& entry, const GivenVector& v) { entry.position = v; });
    command.shape = std::move(table);
  }
}

/// sine: {"amplitude": ..., "waves": ..., ...}; or kind, nodes and numbers of a table.
std::shared_ptr<EditRun> deform(const MeshPointer& mesh, const py::object& markers,
                                const py::object& sine, const std::string& kind,
                                const py::object& nodes, const py::object& numbers,
                                py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, true);
  DeformCommand command;
  command.markers = names_of(markers, "markers");
  if (!sine.is_none()) {
    if (command.markers.empty())
      throw UsageError("sine changes the shape of a body: give its markers");
    command.shape = sine_of(sine);
  } else {
    set_shape(command, kind, nodes, numbers, mesh->mesh().coordinates.dimension());
  }
  const auto held = names_of(taken(keywords, "hold_layers"), "hold_layers");
  set_motion(command.how, command.smooth, {}, keywords);
  return run("deform", mesh, app::holding_layers(held, command.smooth, command), arguments);
}

/// Takes the spacing and the part of a wall out of the keywords.
LayerWall wall_of(py::dict& keywords, std::vector<std::string> markers) {
  LayerWall wall{std::move(markers), {}};
  py::dict bounds;
  for (const char* name : {"xmin", "xmax", "ymin", "ymax"})
    if (const py::object bound = taken(keywords, name); !bound.is_none()) bounds[name] = bound;
  double* const values[] = {&wall.part.xmin, &wall.part.xmax, &wall.part.ymin, &wall.part.ymax};
  const char* const names[] = {"xmin", "xmax", "ymin", "ymax"};
  OptionTable table = option_table(wall.spacing);
  for (std::size_t k = 0; k < 4; ++k)
    if (bounds.contains(names[k])) {
      *values[k] = 0;
      set_options({{.key = names[k], .value = RealOption{values[k]}, .label = "", .help = ""}},
                  bounds);
    }
  const py::object y_plus = taken(keywords, "y_plus"), reynolds = taken(keywords, "reynolds"),
                   length = taken(keywords, "reference_length");
  if (!y_plus.is_none()) {
    if (reynolds.is_none()) throw UsageError("y_plus: expected reynolds with it");
    if (keywords.contains("first"))
      throw UsageError("found first together with y_plus: expected one of them");
    wall.spacing.first = first_height_for_y_plus(y_plus.cast<double>(), reynolds.cast<double>(),
                                                 length.is_none() ? 1.0 : length.cast<double>());
  }
  set_options(table, keywords);
  return wall;
}

void add_columns(LayerOptions& options, const py::object& columns) {
  if (columns.is_none()) return;
  for (const auto& [node, given] : columns.cast<py::dict>()) {
    py::dict settings = given.attr("copy")().cast<py::dict>();
    ColumnOverride own;
    own.node = py::cast<Index>(node);
    if (const py::object count = taken(settings, "columns"); !count.is_none())
      own.columns = count.cast<int>();
    if (const py::object thickness = taken(settings, "thickness"); !thickness.is_none())
      own.thickness = thickness.cast<double>();
    refuse_others(settings, {"columns", "thickness"});
    options.overrides.push_back(own);
  }
}

constexpr std::array spacing_keywords{"count",  "first",    "ratio",
                                      "growth", "total",    "match_outside",
                                      "y_plus", "reynolds", "reference_length"};

/// walls: list of dicts with markers, spacing and bounds each.
std::shared_ptr<EditRun> layers(const MeshPointer& mesh, const py::object& markers,
                                const py::object& walls, const py::object& columns,
                                py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, false);
  LayersCommand command;
  const py::dict common = keywords.attr("copy")().cast<py::dict>();
  LayerWall wall = wall_of(keywords, names_of(markers, "markers"));
  if (!wall.markers.empty()) command.layers.walls.push_back(wall);
  if (!walls.is_none()) {
    for (const py::handle given : walls) {
      py::dict own;  // what the wall does not say is as for all
      for (const char* name : spacing_keywords)
        if (common.contains(name)) own[name] = common[name];
      if (given.contains("first")) taken(own, "y_plus");
      own.attr("update")(given);
      const auto names = names_of(taken(own, "markers"), "walls markers");
      command.layers.walls.push_back(wall_of(own, names));
      refuse_others(own, {"markers", "count", "first", "ratio", "growth", "total", "match_outside",
                          "xmin", "xmax", "ymin", "ymax"});
    }
  }
  add_columns(command.layers, columns);
  set_keywords(command, keywords);
  if (command.layers.walls.empty()) throw UsageError("no wall is given: expected markers or walls");
  validate(command.layers);
  return run("layers", mesh, {command}, arguments);
}

std::shared_ptr<EditRun> replay(const MeshPointer& mesh, const std::string& recipe,
                                py::dict keywords) {
  const RunArguments arguments = run_arguments(keywords, true);
  refuse_others(keywords, {"reference", "config", "progress", "allow_incomplete"});
  io::Recipe read = io::read_recipe(recipe);
  if (read.commands.empty()) throw UsageError(recipe + ": has no commands");
  return run("replay", mesh, std::move(read.commands), arguments);
}

/// The tables of a function's keywords, under headings.
py::list tables_of(const std::string& function) {
  py::list sections;
  const auto add = [&](const char* heading, const OptionTable& table) {
    sections.append(py::make_tuple(heading, described(table)));
  };
  MotionOptions how;
  LayersCommand layered;
  LayerSpacing spacing;
  ScrambleCommand scrambled;
  SineDeformation sine;
  SmoothOptions smoothing;
  RigidMotion motion;
  if (function == "sweep" || function == "sensitivity" || function == "deformer")
    smoothing = independent_of_start(smoothing);
  if (function == "move") add("Motion", joined(option_table(motion), motion_table(how)));
  if (function == "deform" || function == "deformer") add("Motion", motion_table(how));
  if (function == "sweep") {
    OptionTable own = option_table(motion);
    std::erase_if(own, [](const Option& option) {
      return option.key == "rotate" || option.key == "translate";
    });
    add("Motion", joined(std::move(own), motion_table(how)));
  }
  if (function == "sine") add("Sine", option_table(sine));
  if (function == "layers") {
    add("Heights", option_table(spacing));
    add("Layers", option_table(layered));
  }
  if (function == "scramble") add("Options", option_table(scrambled));
  if (function != "scramble" && function != "sine") add("Smoothing", option_table(smoothing));
  return sections;
}

}  // namespace

void bind_commands(py::module_& module) {
  py::class_<EditRun, std::shared_ptr<EditRun>> run(module, "EditRun");
  run.def_property_readonly("mesh", &EditRun::mesh);
  run.def_property_readonly("inverted", &EditRun::inverted);
  run.def_property_readonly("converged", &EditRun::converged);
  run.def_property_readonly("fraction_reached", &EditRun::fraction_reached);
  run.def_property_readonly("linear_solves", &EditRun::linear_solves);
  run.def_property_readonly("why_incomplete", &EditRun::why_incomplete);
  run.def_property_readonly("history", &EditRun::history);
  run.def_property_readonly("warnings", &EditRun::warnings);
  run.def_property_readonly("remarks", &EditRun::remarks);
  run.def("report", &EditRun::report);
  module.def("smooth", &smooth);
  module.def("scramble", &scramble);
  module.def("move", &move);
  module.def("deform", &deform);
  module.def("layers", &layers);
  module.def("replay", &replay);
  module.def("tables_of", &tables_of);
}

}  // namespace winslow::python
