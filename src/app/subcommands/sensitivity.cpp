#include "app/job/edit_job.h"
#include "app/output/quality_csv.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "core/sensitivity/mesh_sensitivity.h"
#include "io/tables/file_defaults.h"
#include "io/tables/table_files.h"

namespace winslow::app {
namespace {

/// One product with the derivative of a moved mesh by its boundary, from file to file.
class SensitivitySubcommand : public Subcommand {
 public:
  explicit SensitivitySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "sensitivity",
            "How a moved mesh depends on its boundary: gradients for shape optimisation")) {
    add_input(app(), input_);
    add_marker_flag(app(), markers_)
        ->required(false)
        ->description("Marker that moved; several, and all that NAME matches with a *");
    add_hold_layers_flag(app(), held_);
    FlagGroup product(app(), "Product");
    app()
        .add_option("--reference-mesh", reference_,
                    "The mesh before the motion, of the same nodes and elements")
        ->required()
        ->option_text("FILE")
        ->group("Product");
    CLI::Option* transpose = product.value(
        "--transpose", transpose_, "FILE.csv",
        "The derivative of a function by all nodes, dJ/dX: CSV of node,dx,dy (0-based "
        "node), of volume meshes node,dx,dy,dz; nodes that are left out have zero. "
        "OUT gets its derivative by the nodes of the boundary");
    CLI::Option* forward = product.value(
        "--forward", forward_, "FILE.csv",
        "Displacements of the boundary, dB, in the same columns. OUT gets those of all "
        "nodes, dX");
    transpose->excludes(forward);
    product
        .value_as("--pivot", pivot_, "X Y [Z]",
                  "With --transpose: also print the derivatives by the shift of the markers and "
                  "by the angle, per degree, by which they turn about this point")
        ->expected(2, 3);
    product.value_as("--axis", axis_, "X Y Z", "The axis of that rotation in volume meshes")
        ->expected(3);
    add_body_flag(app(), bodies_);
    app()
        .get_option("--body")
        ->description(
            "A body that moved, as given to move: its markers moved, and with --transpose the "
            "derivatives by its shift and its angle are printed")
        ->group("Product");
    sine_flag_ = add_sine_flags(app(), sine_);
    sine_flag_
        ->description(
            "The sine wave that deform added to the markers: the derivatives by its "
            "amplitude and by the number of its periods are printed")
        ->needs(transpose);
    smooth_ = independent_of_start(smooth_);
    add_smooth_flags(app(), smooth_);
    add_reading_flags(app(), reading_, "only files of one zone are read");
    add_config_flag(app(), config_);
    FlagGroup output(app(), "Output");
    output.value("-o,--output", output_, "OUT.csv", "The product: CSV of node,dx,dy[,dz]")
        ->required();
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    if (transpose_.empty() == forward_.empty())
      throw UsageError(
          "nothing to multiply: give dJ/dX by --transpose FILE.csv, or "
          "displacements of the boundary by --forward FILE.csv");
    if (markers_.empty() && bodies_.empty())
      throw UsageError("nothing moved: name the markers that did with --marker or --body");
    if (!bodies_.empty() && !(pivot_.empty() && axis_.empty()))
      throw UsageError(
          "found --body together with --pivot or --axis, which are of all markers as one body: "
          "expected pivot=X,Y and axis=X,Y,Z after the name of the body");
    const std::string& table = transpose_.empty() ? forward_ : transpose_;
    check_is_file(output_, "-o");
    check_output(output_);
    check_inputs_kept({output_}, {input_, reference_, table, config_});
    const InterruptGuard interrupts;
    const Prepared prepared = prepare();
    const Coordinates field = read_field(table, prepared.moved);
    CancelOnSignal monitor;
    const MeshSensitivity sensitivity(prepared.state, prepared.command, prepared.moved.coordinates,
                                      {.monitor = &monitor});
    const Coordinates product =
        transpose_.empty() ? sensitivity.forward(field) : sensitivity.transpose(field);
    InterruptGuard::check();
    write_text(output_, csv_of(product, sensitivity));
    if (!quiet_ && transpose_.empty()) warn_of_others(field, sensitivity);
    if (!quiet_) tell(prepared, sensitivity, product);
    return ExitCode::done;
  }

 private:
  class CancelOnSignal final : public SolverMonitor {
   public:
    bool on_iteration(const IterationRecord&, const Coordinates&) override {
      return !InterruptGuard::requested();
    }
    bool cancelled() override { return InterruptGuard::requested(); }
  };

  struct Prepared {
    MeshState state;  ///< the reference mesh
    Mesh moved;
    ResolvedCommand command;
    std::vector<std::string> markers;
    std::vector<MovingBody> bodies;  ///< with pivots
    std::vector<std::string> said;
  };

  io::MeshFile read_one(const std::string& path) const {
    std::vector<io::MeshFile> files = read_zones(path, reading_);
    if (files.size() > 1)
      throw UsageError(path + " has " + std::to_string(files.size()) +
                       " zones, expected one: choose it with --zone N");
    if (!quiet_) print_warnings(warnings_of(files));
    return std::move(files.front());
  }

  Prepared prepare() const {
    std::vector<io::MeshFile> files;
    files.push_back(read_one(reference_));
    Mesh moved = read_one(input_).mesh;
    MeshState state = make_state(files.front().mesh);
    try {
      // The moved mesh with the topology of the reference mesh, which says what corners are flat.
      moved.topology = with_reference(make_state(moved), state.mesh).mesh.topology;
    } catch (const UsageError& error) {
      throw UsageError(reference_ + ": " + error.what());
    }
    if (moved.coordinates.dimension() == 3 && !pivot_.empty() && axis_.empty())
      throw UsageError("--pivot: a rotation in space needs --axis X Y Z");
    const std::vector<MovingBody> bodies = bodies_in(state, files);
    DeformCommand deform;
    deform.markers = markers_;
    for (const MovingBody& body : bodies)
      deform.markers.insert(deform.markers.end(), body.markers.begin(), body.markers.end());
    deform.smooth = smooth_;
    std::vector<Command> commands = holding_layers(held_, smooth_, deform);
    for (Command& command : commands) expand_groups(command, files);
    check_markers(commands, *state.mesh.topology, reference_);
    auto& named = std::get<DeformCommand>(commands.back());
    named.shape = positions(moved, named.markers);
    const std::vector<std::string> markers = named.markers;
    std::vector<ZoneRun> zones = share_out(std::move(files), commands, reference_);
    Prepared out{std::move(state), std::move(moved), ResolvedCommand(SmoothCommand{}),
                 markers,          bodies,           add_file_defaults(zones, config_)};
    const ZoneRun& zone = zones.front();
    if (!held_.empty()) out.state = execute(*zone.commands.front(), out.state).state;
    out.command = io::resolve_files(*zone.commands.back(), zone.source.details.get());
    return out;
  }

  /// The bodies of --body with all of their markers, and with their pivots.
  std::vector<MovingBody> bodies_in(const MeshState& state,
                                    const std::vector<io::MeshFile>& files) const {
    if (bodies_.empty()) return {};
    MoveCommand move;
    move.bodies = bodies_;
    Command command = move;
    expand_groups(command, files);
    check_markers({command}, *state.mesh.topology, reference_);
    const MeshState* states[] = {&state};
    return std::get<MoveCommand>(with_pivot(std::move(command), states)).bodies;
  }

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

  /// Vectors at nodes, zero where the table has none.
  static Coordinates read_field(const std::string& path, const Mesh& mesh) {
    Coordinates field(mesh.coordinates.dimension(), mesh.coordinates.size());
    const DisplacementTable table = io::read_displacements(path);
    std::vector<int> line_of(at(field.size()), 0);
    for (const DisplacementEntry& entry : table.entries) {
      const std::string where = path + ':' + std::to_string(entry.line);
      if (!entry.node)
        throw InputError(where + ": found a place, expected the number of a node: node,dx,dy" +
                         (field.dimension() == 3 ? ",dz" : ""));
      if (*entry.node < 0 || *entry.node >= field.size())
        throw InputError(where + ": found node " + std::to_string(*entry.node) +
                         ", expected 0 to " + std::to_string(field.size() - 1));
      if (int& before = line_of[at(*entry.node)]; std::exchange(before, entry.line) != 0)
        throw InputError(where + ": node " + std::to_string(*entry.node) +
                         " has a row before, expected one");
      if (field.dimension() == 3 && entry.displacement.numbers(3) < 3)
        throw InputError(where + ": found two components, expected dx, dy and dz");
      set_place(field, *entry.node, entry.displacement);
    }
    return field;
  }

  /// Displacements of nodes that depend on the boundary count for nothing.
  void warn_of_others(const Coordinates& field, const MeshSensitivity& sensitivity) const {
    Index others = 0;
    for (Index node = 0; node < field.size(); ++node)
      if (!place_of(field, node).isZero(0) &&
          !std::ranges::binary_search(sensitivity.boundary(), node))
        ++others;
    if (others > 0)
      print_warnings({std::to_string(others) + (others == 1 ? " node" : " nodes") + " of " +
                      forward_ + (others == 1 ? " is" : " are") +
                      " not of the boundary: left out"});
  }

  std::string csv_of(const Coordinates& product, const MeshSensitivity& sensitivity) const {
    const bool space = product.dimension() == 3;
    std::string text = space ? "node,dx,dy,dz\n" : "node,dx,dy\n";
    const auto add = [&](Index node) {
      const Vec3 p = place_of(product, node);
      text += formatted("%lld,%.17g,%.17g", static_cast<long long>(node), p.x(), p.y());
      if (space) text += formatted(",%.17g", p.z());
      text += '\n';
    };
    if (!transpose_.empty()) {
      for (const Index node : sensitivity.boundary()) add(node);
    } else {
      for (Index node = 0; node < product.size(); ++node) add(node);
    }
    return text;
  }

  void tell(const Prepared& prepared, const MeshSensitivity& sensitivity,
            const Coordinates& product) const {
    print_remarks(prepared.said);
    constexpr double far = 0.01;  // of an edge
    if (sensitivity.distance() > far)
      print_warnings({input_ + ": a node is " + formatted("%.2g", sensitivity.distance()) +
                      " of its edges from the solution of the motion, where the derivative is: the "
                      "motion was not converged, or had other options"});
    const auto frozen = sensitivity.frozen();
    std::cout << "Derivative at " << printable(input_) << ": " << sensitivity.boundary().size()
              << " nodes of the boundary, " << sensitivity.solver()
              << formatted("; frozen: knee %.4g", frozen.knee * frozen.knee_raised);
    if (frozen.stuck_nodes > 0) std::cout << ", " << frozen.stuck_nodes << " nodes held at folds";
    if (frozen.heights > 0)
      std::cout << ", corrections of " << frozen.heights << " heights of layers";
    std::cout << '\n';
    if (!transpose_.empty()) print_parameters(prepared, product);
    std::cout << "Wrote " << printable(output_) << '\n';
  }

  void print_parameters(const Prepared& prepared, const Coordinates& on_boundary) const {
    for (const MovingBody& body : prepared.bodies)
      print_by_motion(prepared.moved, body, body.markers.front() + ": ", on_boundary);
    if (!pivot_.empty()) {
      MovingBody body;
      body.markers = prepared.markers;
      body.motion.pivot = GivenVector(pivot_[0], pivot_[1], pivot_.size() > 2 ? pivot_[2] : 0);
      if (!axis_.empty()) body.motion.axis = Vec3(axis_[0], axis_[1], axis_[2]);
      if (on_boundary.dimension() == 2) body.motion.pivot = GivenVector(pivot_[0], pivot_[1]);
      print_by_motion(prepared.moved, body, "", on_boundary);
    }
    if (sine_flag_->count() == 0) return;
    const Mesh& rest = prepared.state.mesh;
    const auto by = [&](SineParameter parameter) {
      return scalar_product(on_boundary, sine_velocities(*rest.topology, rest.coordinates,
                                                         prepared.markers, sine_, parameter));
    };
    print_derivative("", "amplitude", by(SineParameter::amplitude));
    print_derivative("", "number of periods", by(SineParameter::waves));
  }

  static void print_derivative(const std::string& whose, const char* name, double value) {
    std::cout << formatted("  %sby the %-18s %.10g\n", printable(whose).c_str(), name, value);
  }

  static void print_by_motion(const Mesh& moved, const MovingBody& body, const std::string& whose,
                              const Coordinates& on_boundary) {
    constexpr std::array names{"angle, per degree", "shift along x", "shift along y",
                               "shift along z"};
    for (int k = 0; k <= on_boundary.dimension(); ++k) {
      // A body that is only shifted has no axis.
      if (k == 0 && on_boundary.dimension() == 3 && !body.motion.axis) continue;
      const auto parameter = static_cast<MotionParameter>(k);
      print_derivative(whose, names[at(k)],
                       scalar_product(on_boundary, parameter_velocities(moved, body, parameter)));
    }
  }

  std::string input_, reference_, transpose_, forward_, output_, config_;
  std::vector<std::string> markers_, held_;
  std::vector<double> pivot_, axis_;
  std::vector<MovingBody> bodies_;
  SineDeformation sine_;
  CLI::Option* sine_flag_ = nullptr;
  SmoothOptions smooth_;
  io::ReadOptions reading_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_sensitivity_subcommand(CLI::App& program) {
  return std::make_unique<SensitivitySubcommand>(program);
}

}  // namespace winslow::app
