#include "core/sensitivity/mesh_sensitivity.h"

#include "python/arrays.h"
#include "python/edit_run.h"
#include "python/measures.h"
#include "python/monitor.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// The derivative of a moved mesh, and the mesh.
class Sensitivity {
 public:
  /// mesh: before the motion. moved: after it.
  Sensitivity(const MeshPointer& mesh, const MeshPointer& moved, const py::object& markers,
              py::dict keywords)
      : markers_(names_of(markers, "markers")) {
    if (markers_.empty()) throw UsageError("markers: expected the names of what moved");
    const RunArguments arguments = run_arguments(keywords, false);
    DeformCommand deform;
    deform.smooth = independent_of_start(deform.smooth);
    deform.markers = markers_;
    const OptionTable table = option_table(deform.smooth);
    set_options(table, keywords);
    refuse_others(keywords, known_keywords(table, {"config", "progress"}));
    PythonMonitor monitor(arguments.progress);
    Coordinates solved;
    monitor.run([&] {
      const MeshState state = make_state(mesh->mesh());
      Mesh after = moved->mesh();
      after.topology = with_reference(make_state(after), mesh->mesh()).mesh.topology;
      Command command = deform;
      app::expand_groups(command, {mesh->file});
      app::check_markers({command}, mesh->topology(), "the mesh");
      auto& named = std::get<DeformCommand>(command);
      markers_ = named.markers;
      named.shape = positions(after, markers_);
      const app::ZoneRun zone = prepared_zone(*mesh, {command}, arguments, remarks_);
      sensitivity_ = std::make_shared<const MeshSensitivity>(
          state, ResolvedCommand(*zone.commands.front(), zone.files.front()), after.coordinates,
          RunOptions{.monitor = &monitor});
      solved = sensitivity_->mesh();
    });
    mesh_ = with_coordinates(*mesh, std::move(solved));
    boundary_ = frozen(sensitivity_->boundary());
  }

  /// Of a session. mesh: any with the connectivity.
  Sensitivity(const MeshPointer& mesh, std::vector<std::string> markers,
              std::shared_ptr<const MeshSensitivity> made)
      : markers_(std::move(markers)),
        sensitivity_(std::move(made)),
        mesh_(with_coordinates(*mesh, sensitivity_->mesh())),
        boundary_(frozen(sensitivity_->boundary())) {}

  const MeshPointer& mesh() const { return mesh_; }
  const py::object& boundary() const { return boundary_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  double distance() const { return sensitivity_->distance(); }
  std::string solver() const { return sensitivity_->solver(); }

  py::dict frozen_values() const {
    const MeshSensitivity::Frozen held = sensitivity_->frozen();
    py::dict values;
    values["knee"] = held.knee * held.knee_raised;
    values["stuck_nodes"] = held.stuck_nodes;
    return values;
  }

  py::array forward(const py::object& velocities) const {
    const Coordinates given = field_of(velocities, "velocities");
    return product([&] { return sensitivity_->forward(given); });
  }

  py::array transpose(const py::object& function) const {
    const Coordinates& x = mesh_->mesh().coordinates;
    const Coordinates given = coordinates_of(function, x.dimension(), x.size(), "derivative");
    return product([&] { return sensitivity_->transpose(given); });
  }

  /// The velocities of the bodies per degree or unit of a number of their motion.
  py::array velocities(const std::string& parameter, const py::object& markers,
                       const py::object& pivot, const py::object& axis) const {
    MovingBody body{markers.is_none() ? markers_ : names_of(markers, "markers"), {}};
    const OptionTable table = option_table(body.motion);
    py::dict keywords;
    if (!pivot.is_none()) keywords["pivot"] = pivot;
    if (!axis.is_none()) keywords["axis"] = axis;
    set_options(table, keywords);
    constexpr std::array names{"rotate", "translate_x", "translate_y", "translate_z"};
    const auto found = std::ranges::find(names, parameter);
    if (found == names.end())
      throw UsageError("parameter: found \"" + parameter + "\", expected one of " +
                       listed(names, [](const char* name) { return name; }));
    return array_of(parameter_velocities(mesh_->mesh(), body,
                                         static_cast<MotionParameter>(found - names.begin())));
  }

 private:
  static PositionTable positions(const Mesh& moved, const std::vector<std::string>& markers) {
    PositionTable table;
    for (const Index node : moved.topology->markers().nodes_of(markers)) {
      PositionEntry entry;
      entry.node = node;
      entry.position =
          GivenVector::of(moved.coordinates.dimension(), place_of(moved.coordinates, node));
      table.entries.push_back(entry);
    }
    return table;
  }

  /// Vectors at all nodes; or at those of the boundary, and zero at the others.
  Coordinates field_of(const py::object& given, const char* what) const {
    const Coordinates& x = mesh_->mesh().coordinates;
    const std::vector<Index>& nodes = sensitivity_->boundary();
    const bool short_ = py::hasattr(given, "__len__") && py::len(given) == nodes.size() &&
                        nodes.size() != at(x.size());
    if (!short_) return coordinates_of(given, x.dimension(), x.size(), what);
    const Coordinates rows =
        coordinates_of(given, x.dimension(), static_cast<Index>(nodes.size()), what);
    Coordinates field(x.dimension(), x.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      set_place(field, nodes[k], place_of(rows, static_cast<Index>(k)));
    return field;
  }

  template <class Make>
  static py::array product(const Make& make) {
    Coordinates result;
    {
      const py::gil_scoped_release released;
      result = make();
    }
    return array_of(std::move(result));
  }

  std::vector<std::string> markers_, remarks_;
  std::shared_ptr<const MeshSensitivity> sensitivity_;
  MeshPointer mesh_;
  py::object boundary_;
};

}  // namespace

py::object sensitivity_of(const MeshPointer& mesh, std::vector<std::string> markers,
                          std::shared_ptr<const MeshSensitivity> made) {
  return py::cast(Sensitivity(mesh, std::move(markers), std::move(made)));
}

void bind_sensitivity(py::module_& module) {
  py::class_<Sensitivity> of(module, "Sensitivity");
  of.def(py::init<const MeshPointer&, const MeshPointer&, const py::object&, py::dict>());
  of.def_property_readonly("mesh", &Sensitivity::mesh);
  of.def_property_readonly("boundary", &Sensitivity::boundary);
  of.def_property_readonly("distance", &Sensitivity::distance);
  of.def_property_readonly("frozen", &Sensitivity::frozen_values);
  of.def_property_readonly("solver", &Sensitivity::solver);
  of.def_property_readonly("remarks", &Sensitivity::remarks);
  of.def("forward", &Sensitivity::forward);
  of.def("transpose", &Sensitivity::transpose);
  of.def("velocities", &Sensitivity::velocities);
}

}  // namespace winslow::python
