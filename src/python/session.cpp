#include <nlohmann/json.hpp>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/session/deformer.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/keywords.h"
#include "python/measures.h"
#include "python/monitor.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// Claims a session for one call.
class Claim {
 public:
  explicit Claim(std::atomic_flag& flag) : flag_(flag) {
    if (flag_.test_and_set())
      throw UsageError("the deformer is at work in another call: one call at a time");
  }
  ~Claim() { flag_.clear(); }
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  std::atomic_flag& flag_;
};

/// The result of a step, with what EditRun has.
class StepRun {
 public:
  StepRun(std::shared_ptr<const app::ZoneRun> given, const Command& command, CommandResult result,
          const MeshPointer& source, std::vector<std::string> remarks)
      : given_(std::move(given)),
        command_(command),
        record_(app::make_record(command, std::move(result.smooth), result.state.mesh)),
        mesh_(with_coordinates(*source, std::move(result.state.mesh.coordinates))),
        remarks_(std::move(remarks)) {}

  const MeshPointer& mesh() const { return mesh_; }
  const SmoothResult& result() const { return record_.result; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  std::string why_incomplete() const {
    const SmoothResult& of = record_.result;
    if (of.fraction_reached >= 1 && of.limited_by.empty()) return {};
    return in_words_of_python(winslow::why_incomplete(of));
  }
  std::string report() const {
    const py::gil_scoped_release released;
    app::ZoneRun zone = *given_;
    zone.commands = {command_};
    zone.result.mesh.coordinates = mesh_->mesh().coordinates;
    app::measure(zone, {});
    app::RunReport report;
    report.command = "step";
    report.input = mesh_->path;
    report.commands.push_back(record_);
    return app::make_report({zone}, report).dump();
  }

 private:
  std::shared_ptr<const app::ZoneRun> given_;
  Command command_;
  app::CommandRecord record_;
  MeshPointer mesh_;
  std::vector<std::string> remarks_;
};

class Session;

struct SessionCheckpoint {
  const Session* of = nullptr;
  Deformer::Checkpoint checkpoint;
};

class Session {
 public:
  /// markers: what moves as a rule; None: each call says what moves.
  Session(const MeshPointer& mesh, const py::object& markers, py::dict keywords) {
    RunArguments arguments;
    take(keywords, "config", arguments.config, "the name of a file");
    take(keywords, "reference", arguments.reference, "a mesh");
    DeformCommand deform;
    deform.smooth = independent_of_start(deform.smooth);
    if (!markers.is_none()) {
      deform.markers = names_of(markers, "markers");
      if (deform.markers.empty())
        throw UsageError("markers: found none, expected the names of what moves, or None");
    }
    const std::vector<std::string> held = names_of(taken(keywords, "hold_layers"), "hold_layers");
    set_motion_options(deform, keywords);
    PositionTable table;
    table.source = "positions";
    deform.shape = table;
    {
      const py::gil_scoped_release released;
      start(*mesh, deform, held, arguments);
    }
    given_ = zone_->source.mesh.topology == mesh->file.mesh.topology
                 ? mesh
                 : result_mesh(*mesh, zone_->source.mesh, true);
  }

  const std::vector<std::string>& markers() const { return markers_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  py::array nodes() const { return frozen(nodes_); }
  const MeshPointer& given() const { return given_; }

  MeshPointer mesh() {
    const Claim claim(at_work_);
    return with_coordinates(*given_, *deformer_->coordinates());
  }

  /// The coordinates of the last complete step, which the array keeps alive.
  py::array points() {
    const Claim claim(at_work_);
    using Kept = std::shared_ptr<const Coordinates>;
    auto* kept = new Kept(deformer_->coordinates());
    const py::capsule owner(kept, [](void* p) { delete static_cast<Kept*>(p); });
    return view_of(**kept, owner);
  }

  py::array displacement() {
    const Claim claim(at_work_);
    return array_of(deformer_->displacement());
  }

  void set_boundary(const py::object& places, const py::object& ids) {
    const std::vector<Index> nodes = nodes_of(ids);
    const Coordinates rows = rows_of(places, nodes, "places");
    PositionTable table;
    table.source = "places";
    table.entries.reserve(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      table.entries.push_back(
          {nodes[k], GivenVector::of(rows.dimension(), place_of(rows, static_cast<Index>(k)))});
    const Claim claim(at_work_);
    deformer_->set_shape({}, table);
    set_ = DeformCommand{{}, std::move(table), how_, smooth_};
  }

  void set_motion(const py::object& markers, const py::object& bodies, py::dict keywords) {
    MoveCommand move{{}, how_, smooth_};
    if (!bodies.is_none()) {
      if (!markers.is_none())
        throw UsageError("found bodies together with markers, which are of a single body");
      move.bodies = bodies_of(bodies);
      refuse_others(keywords, {"bodies"});
    } else {
      MovingBody body{moved(markers), {}};
      const OptionTable table = option_table(body.motion);
      if (!keywords.contains("rotate") && !keywords.contains("translate"))
        throw UsageError("nothing to do: give rotate, translate, or both");
      set_options(table, keywords);
      refuse_others(keywords, known_keywords(table, {"markers", "bodies"}));
      move.bodies.push_back(std::move(body));
    }
    Command command = checked(std::move(move));
    const Claim claim(at_work_);
    deformer_->set_motion(std::get<MoveCommand>(command).bodies);
    set_ = std::move(command);
  }

  void set_sine(const py::object& markers, const py::object& sine) {
    Command command = checked(DeformCommand{moved(markers), sine_of(sine), how_, smooth_});
    const auto& deform = std::get<DeformCommand>(command);
    const Claim claim(at_work_);
    deformer_->set_shape(deform.markers, deform.shape);
    set_ = std::move(command);
  }

  std::shared_ptr<StepRun> step(double tolerance, const py::object& progress) {
    if (!(tolerance >= 0 && tolerance < 1))
      throw UsageError("tolerance: expected more than 0, less than 1");
    if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
      throw UsageError("progress: expected a function of one argument, the iteration");
    const Claim claim(at_work_);
    if (!set_)
      throw UsageError("no boundary is set: call set_motion(), set_sine() or set_boundary() first");
    PythonMonitor monitor(progress);
    CommandResult result;
    monitor.run([&] { result = deformer_->step(tolerance, &monitor); });
    return std::make_shared<StepRun>(zone_, *set_, std::move(result), given_, remarks_);
  }

  /// The derivative as an object of its own, which outlives the next step.
  py::object sensitivity() {
    const Claim claim(at_work_);
    std::shared_ptr<const MeshSensitivity> made;
    PythonMonitor monitor{py::none()};
    monitor.run([&] { made = deformer_->sensitivity(&monitor); });
    return sensitivity_of(given_, markers_, std::move(made));
  }

  py::array velocities(const py::object& boundary, const py::object& ids) {
    const Coordinates field = on_boundary(boundary, ids, Coordinates{}, "boundary");
    const Claim claim(at_work_);
    Coordinates all;
    {
      const py::gil_scoped_release released;
      all = deformer_->velocities(field);
    }
    return array_of(std::move(all));
  }

  double largest_valid(const py::object& places, const py::object& ids) {
    const Coordinates field =
        on_boundary(places, ids, deformer_->given().mesh.coordinates, "places");
    const Claim claim(at_work_);
    const py::gil_scoped_release released;
    return deformer_->largest_valid(field);
  }

  SessionCheckpoint checkpoint() {
    const Claim claim(at_work_);
    return {this, deformer_->checkpoint()};
  }
  void restore(const SessionCheckpoint& checkpoint) {
    if (checkpoint.of != this) throw UsageError("the checkpoint is of another deformer");
    const Claim claim(at_work_);
    deformer_->restore(checkpoint.checkpoint);
  }

 private:
  static void set_motion_options(DeformCommand& deform, py::dict& keywords) {
    for (const char* name : {"progress", "allow_incomplete"})
      if (keywords.contains(name))
        throw UsageError(std::string(name) + " is an argument of step()");
    python::set_motion(deform.how, deform.smooth, {}, keywords);
  }

  void start(const MeshValue& mesh, const DeformCommand& deform,
             const std::vector<std::string>& held, const RunArguments& arguments) {
    Command command = deform;
    app::expand_groups(command, {mesh.file});
    app::check_markers({command}, mesh.topology(), "the mesh");
    markers_ = std::get<DeformCommand>(command).markers;
    zone_ =
        std::make_shared<const app::ZoneRun>(prepared_zone(mesh, {command}, arguments, remarks_));
    const auto& ready = std::get<DeformCommand>(*zone_->commands.front());
    how_ = ready.how;
    smooth_ = independent_of_start(ready.smooth);  // as the deformer takes it
    if (!markers_.empty()) nodes_ = mesh.topology().markers().nodes_of(markers_);
    MeshState given = zone_->result;
    const std::vector<Command> commands = app::holding_layers(held, smooth_, SmoothCommand{});
    if (commands.size() > 1) {
      app::check_markers({commands.front()}, mesh.topology(), "the mesh");
      given = execute(commands.front(), given).state;
    }
    deformer_.emplace(std::move(given), DeformerOptions{smooth_, how_, zone_->files.front()});
  }

  std::vector<std::string> moved(const py::object& markers) const {
    std::vector<std::string> names = markers.is_none() ? markers_ : names_of(markers, "markers");
    if (names.empty())
      throw UsageError("nothing to move: give markers, here or where the deformer is made");
    return names;
  }

  /// The command with its groups of markers replaced. Throws UsageError for unknown ones.
  Command checked(Command command) const {
    app::expand_groups(command, {given_->file});
    app::check_markers({command}, given_->topology(), "the mesh");
    return command;
  }

  std::vector<Index> nodes_of(const py::object& ids) const {
    if (ids.is_none()) {
      if (nodes_.empty())
        throw UsageError("found rows without ids: expected nodes, or a deformer of markers");
      return nodes_;
    }
    const auto given = InputArray<Index>::ensure(ids);
    if (!given || given.ndim() != 1) {
      PyErr_Clear();
      throw UsageError("nodes: expected an array of ids of nodes");
    }
    std::vector<Index> nodes(given.data(), given.data() + given.size());
    const Index count = given_->topology().node_count();
    for (const Index node : nodes)
      if (node < 0 || node >= count)
        throw UsageError("nodes: found " + std::to_string(node) + ", expected 0 to " +
                         std::to_string(count - 1));
    return nodes;
  }

  /// Rows for some nodes: from an array of these, or from one of all nodes.
  Coordinates rows_of(const py::object& array, const std::vector<Index>& nodes,
                      const char* what) const {
    const Coordinates& x = given_->mesh().coordinates;
    const bool whole = py::hasattr(array, "__len__") && py::len(array) == at(x.size()) &&
                       nodes.size() != at(x.size());
    const Index count = whole ? x.size() : static_cast<Index>(nodes.size());
    Coordinates rows = coordinates_of(array, x.dimension(), count, what);
    if (!whole) return rows;
    Coordinates own(x.dimension(), static_cast<Index>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      set_place(own, static_cast<Index>(k), place_of(rows, nodes[k]));
    return own;
  }

  /// Vectors at all nodes: `others` (empty: zero), and the rows at those that they are of.
  Coordinates on_boundary(const py::object& array, const py::object& ids, const Coordinates& others,
                          const char* what) const {
    const Coordinates& x = given_->mesh().coordinates;
    if (ids.is_none() && py::hasattr(array, "__len__") && py::len(array) == at(x.size()))
      return coordinates_of(array, x.dimension(), x.size(), what);
    const std::vector<Index> nodes = nodes_of(ids);
    const Coordinates rows = rows_of(array, nodes, what);
    Coordinates field = others.empty() ? Coordinates(x.dimension(), x.size()) : others;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      set_place(field, nodes[k], place_of(rows, static_cast<Index>(k)));
    return field;
  }

  MeshPointer given_;
  std::shared_ptr<const app::ZoneRun> zone_;  // of the mesh as given
  std::vector<std::string> markers_, remarks_;
  std::vector<Index> nodes_;
  MotionOptions how_;
  SmoothOptions smooth_;
  std::optional<Deformer> deformer_;
  // What the next step is; what the last complete one was. None: there is none.
  std::optional<Command> set_;
  std::atomic_flag at_work_;
};

}  // namespace

void bind_session(py::module_& module) {
  py::class_<StepRun, std::shared_ptr<StepRun>> run(module, "StepRun");
  run.def_property_readonly("mesh", &StepRun::mesh);
  run.def_property_readonly("inverted", [](const StepRun& of) { return of.result().inverted; });
  run.def_property_readonly("converged", [](const StepRun& of) { return of.result().converged; });
  run.def_property_readonly("fraction_reached",
                            [](const StepRun& of) { return of.result().fraction_reached; });
  run.def_property_readonly("linear_solves",
                            [](const StepRun& of) { return of.result().linear_solves; });
  run.def_property_readonly("history", [](const StepRun& of) { return of.result().history; });
  run.def_property_readonly("why_incomplete", &StepRun::why_incomplete);
  run.def_property_readonly("warnings", [](const StepRun&) { return std::vector<std::string>(); });
  run.def_property_readonly("remarks", &StepRun::remarks);
  run.def("report", &StepRun::report);

  py::class_<SessionCheckpoint>(module, "Checkpoint");
  py::class_<Session> session(module, "Session");
  session.def(py::init<const MeshPointer&, const py::object&, py::dict>());
  session.def_property_readonly("markers", &Session::markers);
  session.def_property_readonly("remarks", &Session::remarks);
  session.def_property_readonly("nodes", &Session::nodes);
  session.def_property_readonly("given", &Session::given);
  session.def_property_readonly("mesh", &Session::mesh);
  session.def_property_readonly("points", &Session::points);
  session.def("displacement", &Session::displacement);
  session.def("set_boundary", &Session::set_boundary);
  session.def("set_motion", &Session::set_motion);
  session.def("set_sine", &Session::set_sine);
  session.def("step", &Session::step);
  session.def("sensitivity", &Session::sensitivity);
  session.def("velocities", &Session::velocities);
  session.def("largest_valid", &Session::largest_valid);
  session.def("checkpoint", &Session::checkpoint);
  session.def("restore", &Session::restore);
}

}  // namespace winslow::python
