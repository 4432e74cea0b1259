#include "core/command/command.h"

#include <cstdio>
#include <random>

#include "core/command/local_command.h"
#include "core/error.h"
#include "core/layers/volume_measures.h"
#include "core/linear/krylov.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "core/strategy/held_walls.h"
#include "core/strategy/sliding.h"
#include "core/strategy/smooth_run.h"
#include "core/strategy/surface_first.h"
#include "core/strategy/surface_shape.h"
#include "core/strategy/volume_layering.h"
#include "core/vcv/sphere/node_vcv.h"

namespace winslow {

namespace {

// Rounded to keep names short: the command itself has all digits.
std::string angle(double degrees) {
  const double rounded = std::round(100 * degrees) / 100;
  return number_text(rounded != 0 ? rounded : degrees);
}

std::string length(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// The names; of many only the first and the number of the others.
std::string list(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  const std::size_t shown = names.size() <= most ? names.size() : 3;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (text.empty() ? "" : ", ") + names[i];
  if (shown < names.size())
    text += " and " + std::to_string(names.size() - shown) + " other markers";
  return text;
}

std::vector<std::string> markers_of(const std::vector<LayerWall>& walls) {
  std::vector<std::string> markers;
  for (const LayerWall& wall : walls)
    markers.insert(markers.end(), wall.markers.begin(), wall.markers.end());
  return markers;
}

std::vector<std::string> markers_of(const std::vector<MovingBody>& bodies) {
  std::vector<std::string> markers;
  for (const MovingBody& body : bodies)
    markers.insert(markers.end(), body.markers.begin(), body.markers.end());
  return markers;
}

std::string describe_one(const SmoothCommand&) { return "Smooth"; }

std::string describe_body(const MovingBody& body, bool begins) {
  const RigidMotion& motion = body.motion;
  const bool turns = motion.rotate != 0, shifts = motion.translate != Vec3(0, 0, 0);
  const Vec3& by = motion.translate;
  const bool in_space = motion.translate.numbers(motion.axis ? 3 : 2) == 3;
  const std::string way =
      "(" + length(by.x()) + ", " + length(by.y()) + (in_space ? ", " + length(by.z()) : "") + ")";
  const std::string who = list(body.markers);
  if (turns) {
    return (begins ? "Rotate " : "rotate ") + who + " by " + angle(motion.rotate) + " deg" +
           (shifts ? " and move it by " + way : "");
  }
  return (begins ? "Move " : "move ") + who + " by " + way;
}

std::string describe_one(const MoveCommand& command) {
  std::string text;
  for (const MovingBody& body : command.bodies)
    text += (text.empty() ? "" : ", ") + describe_body(body, text.empty());
  return text;
}

// Nodes inside the mesh, which a table may have as well, belong to no marker.

std::string describe_shape(const SineDeformation& sine, const std::string& markers) {
  return "Deform " + markers + ": sine, amplitude " + length(sine.amplitude) + ", " +
         number_text(sine.waves) + " waves";
}

std::string describe_shape(const DisplacementTable& table, const std::string& markers) {
  const bool places = std::ranges::any_of(
      table.entries, [](const DisplacementEntry& entry) { return !entry.node; });
  return "Displace " + std::string(places ? "what lies in " : "") +
         std::to_string(table.entries.size()) + (places ? " places" : " nodes") +
         (markers.empty() ? "" : " of " + markers);
}

std::string describe_shape(const PositionTable& table, const std::string& markers) {
  return "Put " + std::to_string(table.entries.size()) + " nodes" +
         (markers.empty() ? "" : " of " + markers) + " to given positions";
}

std::string describe_one(const DeformCommand& command) {
  const std::string markers = list(command.markers);
  return std::visit([&](const auto& shape) { return describe_shape(shape, markers); },
                    command.shape);
}

std::string describe_one(const ScrambleCommand& command) {
  return "Scramble, seed " + std::to_string(command.seed);
}

std::string describe_one(const EditVcvCommand& command) {
  const std::size_t count = command.edits.size();
  const bool resets = std::all_of(command.edits.begin(), command.edits.end(),
                                  [](const VcvEdit& edit) { return edit.resets(); });
  const std::string verb = resets ? "Reset" : "Edit";
  if (count == 1) return verb + " the VCV of node " + std::to_string(command.edits[0].node);
  return verb + " the VCVs of " + std::to_string(count) + " nodes";
}

std::string describe_one(const LayersCommand& command) {
  const std::vector<std::string> markers = markers_of(command.layers.walls);
  int count = 0;
  for (const LayerWall& wall : command.layers.walls) count = std::max(count, wall.spacing.count);
  if (command.task == LayerTask::hold) return "Hold the layers at " + list(markers);
  if (command.task == LayerTask::respace) return "Space the layers at " + list(markers) + " anew";
  return "Insert " + std::to_string(count) + " layers at " + list(markers);
}

CommandResult finish(const MeshState& state, Coordinates x, SmoothResult smooth) {
  CommandResult result{state, std::move(smooth)};
  result.state.mesh.coordinates = std::move(x);
  return result;
}

/// Refuses, by name, options that surface meshes do not support.
void require_surface_options(const SmoothOptions& smooth, const Topology& topology) {
  const auto refuse = [&](std::string_view what) { require_plane(topology, what); };
  if (smooth.formulation != Formulation::variational) refuse("the pointwise form");
  if (smooth.outer == OuterMethod::picard) refuse("the fixed-point iteration");
  if (smooth.untangle == Untangle::picard) refuse("untangling by the fixed-point iteration");
  if (smooth.keep_outside.given()) refuse("keep-outside");
}

/// Whether the nodes of a surface mesh were moved onto a reference surface.
bool is_on_reference(const MeshState& state) { return state.surface && state.surface->reference; }

/// The state of a surface mesh with the shape of its nodes. Moves the nodes onto the shape if that
/// is, or was, a reference surface.
MeshState with_shape(const MeshState& state, const ResolvedSlide& slide) {
  MeshState copy = state;
  if (!is_surface(*state.mesh.topology)) return copy;
  copy.surface = surface_shape(state, slide);
  if (is_on_reference(state) || slide.files().reference)
    copy.mesh.coordinates = put_on(copy.surface->boundary, std::move(copy.mesh.coordinates));
  return copy;
}

/// The start of a command: sliding nodes of a volume mesh are projected onto their reference
/// surface. Before a motion, which needs valid meshes, the projection must not invert elements.
/// None: no reference surface.
std::optional<ReferenceStart> on_reference(const Command& command, const MeshState& state,
                                           const RunOptions& options) {
  const SmoothOptions* smooth = smooth_options(command);
  if (!smooth || smooth->slide.reference.empty()) return std::nullopt;
  ReferenceStart placed = put_on_reference({smooth->slide, options.files}, state, options.start);
  if (!std::holds_alternative<SmoothCommand>(command))
    require_no_more_inverted(smooth->slide, state.mesh, placed.state.mesh);
  return placed;
}

/// Refuses, by name, commands and options that the kind of mesh does not support, and vectors with
/// a wrong number of components. Entries of displacement tables are checked later, when they are
/// matched to nodes, with their line numbers.
void require_dimension(const Command& command, const MeshState& state) {
  const Topology& topology = *state.mesh.topology;
  const int dimension = topology.cell_dimension();
  const bool surface = is_surface(topology);
  const SmoothOptions* smooth = smooth_options(command);
  std::visit(
      [&](const auto& c) {
        if (surface && !c.serves_surfaces)
          throw UsageError(std::string(c.name) +
                           ": only for plane and volume meshes, and this is a surface mesh");
        if constexpr (requires { c.how.floor; }) c.how.floor.require_dimension(dimension);
        if constexpr (requires { c.bodies; })
          for (const MovingBody& body : c.bodies)
            static_cast<void>(resolve_motion(body.motion, dimension, Vec3(0, 0, 0)));
      },
      command);
  if (!smooth) return;
  const bool moves = !std::holds_alternative<LayersCommand>(command);
  require_fixed(smooth->slide, topology, moves ? markers_of(command) : std::vector<std::string>{});
  if (surface) require_surface_options(*smooth, topology);
  validate_vcvs(*smooth, dimension);
  validate(smooth->keep_outside, dimension);
}

/// Quality limits require a path.
void require_path(const MotionOptions& how, const SmoothOptions& smooth) {
  if (!how.floor.given() || follows_path(how, smooth)) return;
  throw UsageError(
      "limits of the quality (min-quality) are kept along the path of a motion: they need 0 steps, "
      "smoothing afterwards, and another outer iteration than picard");
}

/// Throws UsageError for options that a motion refuses.
void require_sound(const MotionOptions& how, const SmoothOptions& smooth) {
  if (how.increments < 0) throw UsageError("the number of increments is negative");
  validate(smooth);
  require_path(how, smooth);
  if (smooth.slide.surface_first)
    throw UsageError(
        "surface_first: a motion smooths the boundary together with the interior; it "
        "is for the command smooth");
  if (smooth.raise_worst && how.floor.given())
    throw UsageError(
        "raise_worst: limits of the quality end a motion before they are broken and know nothing "
        "of what comes after it: expected one of the two");
}

/// The result of a motion of a volume mesh, with the columns of its layers turned with their walls.
CommandResult with_carried_layers(const MeshState& before, CommandResult result) {
  MeshState& state = result.state;
  if (state.layers && state.mesh.topology->kind() == MeshKind::volume)
    state.layers = std::make_shared<const LayerStack>(
        carried_by_walls(*state.layers, before.mesh.coordinates, state.mesh.coordinates));
  return result;
}

CommandResult run_motion(const MeshState& state, const Motion& motion, const BodyNodes& bodies,
                         const MotionOptions& how, const SmoothOptions& smooth,
                         const RunOptions& options) {
  require_sound(how, smooth);
  RunOptions run = options;
  run.bodies = &bodies;
  if (how.smooth_after && holds_layers(state)) {
    CommandResult result{state, {}};
    result.state.reference = reference_of(state);
    const bool plane = state.mesh.topology->kind() != MeshKind::volume;
    result.smooth =
        (plane ? move_with_layers : move_with_held_walls)(result.state, motion, how, smooth, run);
    return plane ? result : with_carried_layers(state, std::move(result));
  }
  Coordinates x = starting_point(state, options);
  SmoothResult result = smooth_motion(state, motion, how, smooth, x, run);
  return with_carried_layers(state, finish(state, std::move(x), std::move(result)));
}

CommandResult execute_one(const SmoothCommand& command, const MeshState& given,
                          const RunOptions& options) {
  validate(command.smooth);
  const MeshState state = with_shape(given, {command.smooth.slide, options.files});
  Coordinates x = starting_point(state, options);
  RunOptions run = options;
  // Edited VCVs define the wanted shapes instead.
  const auto plane_vcvs = state.vcvs.plane();
  run.never_worse = !state.vcvs.by_hand() && (!plane_vcvs || plane_vcvs->edits().empty());
  SmoothResult result = command.smooth.slide.surface_first
                            ? smooth_surface_first(state, command.smooth, x, run)
                            : smooth_interior(state, command.smooth, x, run);
  return finish(state, std::move(x), std::move(result));
}

std::unique_ptr<Motion> motion_of(const MoveCommand& command, const MeshState& state) {
  return make_motion(*state.mesh.topology, state.mesh.coordinates, std::span(command.bodies));
}

std::unique_ptr<Motion> motion_of(const DeformCommand& command, const MeshState& state) {
  return std::visit(
      [&](const auto& shape) {
        return make_motion(*state.mesh.topology, state.mesh.coordinates, command.markers, shape);
      },
      command.shape);
}

BodyNodes bodies_of(const Command& command, const Motion& motion, const MeshState& state) {
  return markers_of(command).empty() ? body_nodes_of_table(motion, state.mesh)
                                     : body_nodes(motion, state.mesh.coordinates);
}

template <class Moving>
requires(requires(Moving command) { command.how; }) CommandResult
    execute_one(const Moving& command, const MeshState& state, const RunOptions& options) {
  const auto motion = motion_of(command, state);
  const BodyNodes bodies = bodies_of(command, *motion, state);
  return run_motion(state, *motion, bodies, command.how, command.smooth, options);
}

/// Uniform in [0, 1) from the generator's top 53 bits: std::uniform_real_distribution may differ
/// from one standard library to the next, and a seed must give the same mesh everywhere.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

CommandResult scrambled(const MeshState& state, Coordinates x) {
  SmoothResult result;
  result.converged = true;
  return finish(state, std::move(x), std::move(result));
}

/// Nodes stay on the surface, and near their positions so that the mesh still covers it once.
CommandResult scramble_surface(const MeshState& state, std::mt19937_64& generator) {
  constexpr double reach = 6;  // mean edges at the node
  const MeshState shaped = is_on_reference(state) ? state : with_shape(state, {});
  const auto classes = std::make_shared<NodeClasses>(state.mesh.topology);
  slide_on_surface(*shaped.surface, state.mesh.coordinates, *classes);
  const NodeUnknowns unknowns(classes, 1);
  std::vector<double> lengths(unknowns.unknowns());
  unknowns.lengths(state.mesh.coordinates, lengths);
  for (double& length : lengths) length *= reach * (2 * uniform(generator) - 1);
  Coordinates x = state.mesh.coordinates;
  unknowns.advance(lengths, 1, x);
  return scrambled(shaped, std::move(x));
}

CommandResult execute_one(const ScrambleCommand& command, const MeshState& state,
                          const RunOptions&) {
  std::mt19937_64 generator(command.seed);
  if (is_surface(*state.mesh.topology)) return scramble_surface(state, generator);
  const Topology& topology = *state.mesh.topology;
  Coordinates x = state.mesh.coordinates;
  std::vector<Index> used;
  for (Index node = 0; node < topology.node_count(); ++node)
    if (topology.used(node)) used.push_back(node);
  const Box<3> box = body_box(x, used);
  const std::vector<Index> stay = interface_nodes_inside(topology);
  for (const Index node : topology.interior_nodes()) {
    if (std::ranges::binary_search(stay, node)) continue;
    Vec3 share(0, 0, 0);
    for (double& component : share.head(x.dimension())) component = uniform(generator);
    set_place(x, node, box.min + box.size().cwiseProduct(share));
  }
  return scrambled(state, std::move(x));
}

CommandResult execute_one(const EditVcvCommand& command, const MeshState& state,
                          const RunOptions& options) {
  validate(command.smooth);
  if (command.edits.empty()) throw UsageError("no VCV is given to edit");
  MeshState edited = with_shape(state, {command.smooth.slide, options.files});
  if (const auto plane = state.vcvs.plane())
    edited.vcvs = edit_vcvs(*plane, command.edits);
  else
    edited.vcvs = edit_vcvs(*state.mesh.topology, state.vcvs.by_hand().get(), command.edits);
  Coordinates x = starting_point(edited, options);
  // Small edits in a row are not to be lost in the tolerance, and one that is taken back leaves the
  // mesh as it was.
  SmoothResult result = smooth_interior(edited, independent_of_start(command.smooth), x, options);
  return finish(edited, std::move(x), std::move(result));
}

CommandResult execute_one(const LayersCommand& command, const MeshState& state,
                          const RunOptions& options) {
  validate(command.smooth);
  CommandResult result{state, {}};
  if (state.mesh.topology->kind() == MeshKind::volume) {
    if (command.task == LayerTask::insert) {
      result.smooth = insert_layers_in_space(command, result.state, options);
      return result;
    }
    if (command.task == LayerTask::respace)
      require_plane(*state.mesh.topology, "layers that are spaced anew");
    hold_walls(command.layers.walls, result.state);
    result.smooth.converged = true;
    result.smooth.inverted =
        check_validity(*state.mesh.topology, state.mesh.coordinates, command.smooth.threads)
            .inverted;
    return result;
  }
  result.smooth = run_layers(command, result.state, options);
  return result;
}

CommandResult carry_out(const Command& command, const MeshState& state, const RunOptions& options) {
  return std::visit([&](const auto& c) { return execute_one(c, state, options); }, command);
}

/// Whether a command is a motion that moves no node. Throws UsageError for options that it refuses.
bool moves_nothing(const Command& command, const MeshState& state) {
  return std::visit(
      [&](const auto& c) {
        if constexpr (requires { c.how; }) {
          require_sound(c.how, c.smooth);
          return !motion_of(c, state)->moves();
        }
        return false;
      },
      command);
}

CommandResult unchanged(const MeshState& state) {
  CommandResult result{state, {}};
  result.smooth.converged = result.smooth.nothing_moves = true;
  const Mesh& mesh = state.mesh;
  const std::vector<Vec3> normals = reference_normals(state, mesh.coordinates);
  result.smooth.inverted = check_validity(*mesh.topology, mesh.coordinates, 0, normals).inverted;
  return result;
}

/// The command with what its options leave open: what happens to the nodes in which regions meet,
/// and the tolerance of a run from a start of its own, as drags have.
Command completed(Command command, const RunOptions& options) {
  const bool motion = std::visit(
      [](const auto& c) {
        return requires { c.how; };
      },
      command);
  if (SmoothOptions* smooth = smooth_options(command)) {
    smooth->slide.interfaces = interfaces_in(smooth->slide.interfaces, motion);
    if (options.start) *smooth = independent_of_start(std::move(*smooth));
  }
  return command;
}

/// Executes a command on a plane or volume mesh: in coordinates near the mesh, with sliding nodes
/// on their reference surface.
CommandResult carry_out_near_origin(const Command& command, const MeshState& state,
                                    const RunOptions& options, const CarryOut& carry_out) {
  const LocalFrame frame(state.mesh);
  const std::optional<ReferenceStart> placed = on_reference(command, state, options);
  const MeshState& from = placed ? placed->state : state;
  RunOptions how = options;
  if (placed) how.start = placed->start ? &*placed->start : nullptr;
  return frame.shifts() ? carry_out_in(frame, command, from, how, carry_out)
                        : carry_out(command, from, how);
}

}  // namespace

bool keeps_reference(const Command& command) {
  if (const auto* layers = std::get_if<LayersCommand>(&command))
    return layers->task == LayerTask::hold;
  return std::visit(
      [](const auto& c) {
        return requires { c.how; }
        || std::is_same_v<decltype(c), const ScrambleCommand&>;
      },
      command);
}

std::string_view command_name(const Command& command) {
  return std::visit([](const auto& c) { return c.name; }, command);
}

std::vector<Command> all_commands() {
  return []<std::size_t... kinds>(std::index_sequence<kinds...>) {
    return std::vector<Command>{Command(std::in_place_index<kinds>)...};
  }
  (std::make_index_sequence<std::variant_size_v<Command>>{});
}

std::string describe(const Command& command) {
  return std::visit([](const auto& c) { return describe_one(c); }, command);
}

SmoothOptions* smooth_options(Command& command) {
  return std::visit(
      [](auto& c) -> SmoothOptions* {
        if constexpr (requires { c.smooth; })
          return &c.smooth;
        else
          return nullptr;
      },
      command);
}
const SmoothOptions* smooth_options(const Command& command) {
  return smooth_options(const_cast<Command&>(command));  // only read
}

bool follows_path(const MotionOptions& how, const SmoothOptions& smooth) {
  return how.increments == 0 && how.smooth_after && smooth.outer != OuterMethod::picard;
}

bool asks_for_heights(const Command& command) {
  const auto* layers = std::get_if<LayersCommand>(&command);
  return layers && layers->task != LayerTask::hold;
}

std::vector<std::string> markers_of(const Command& command) {
  return std::visit(
      [](const auto& c) {
        if constexpr (requires { c.markers; }) {
          return c.markers;
        } else if constexpr (requires { c.bodies; }) {
          return markers_of(c.bodies);
        } else if constexpr (requires { c.layers.walls; }) {
          return markers_of(c.layers.walls);
        } else {
          return std::vector<std::string>{};
        }
      },
      command);
}

Command with_pivot(Command command, std::span<const MeshState* const> states) {
  auto* move = std::get_if<MoveCommand>(&command);
  if (move == nullptr) return command;
  for (MovingBody& body : move->bodies) {
    if (body.motion.pivot) continue;
    Box<3> box = Box<3>::empty();
    bool found = false;
    for (const MeshState* state : states) {
      const Markers& markers = state->mesh.topology->markers();
      for (const std::string& name : body.markers) {
        if (!markers.find(name)) continue;
        const std::vector<Index> nodes = markers.nodes_of(std::span(&name, 1));
        if (nodes.empty()) continue;
        found = true;
        box.add(body_box(state->mesh.coordinates, nodes));
      }
    }
    if (found) body.motion.pivot = body_centre(box);
  }
  return command;
}

ResolvedCommand::ResolvedCommand(Command command, SlideFiles files)
    : command_(std::move(command)), files_(std::move(files)) {
  const SmoothOptions* smooth = smooth_options(command_);
  const ResolvedSlide slide(smooth ? smooth->slide : SlideOptions{}, files_);
  if (files_.reference && !slide.files().reference)
    throw UsageError(
        "a reference surface is given, and the command does not name it: expected a "
        "name in slide.reference");
}

CommandResult execute(const ResolvedCommand& resolved, const MeshState& state,
                      const RunOptions& given) {
  const Command command = completed(resolved.command(), given);
  RunOptions options = given;
  options.files = resolved.files();
  const LinearCheckpoint checkpoint([monitor = options.monitor] {
    if (monitor && monitor->cancelled()) throw Cancelled();
  });
  require_dimension(command, state);
  if (moves_nothing(command, state)) return unchanged(state);
  CommandResult result = is_surface(*state.mesh.topology)
                             ? carry_out(command, state, options)
                             : carry_out_near_origin(command, state, options, carry_out);
  result.state.reference = keeps_reference(command) ? reference_of(state) : nullptr;
  // The count always refers to the returned mesh.
  const Mesh& mesh = result.state.mesh;
  const std::vector<Vec3> normals = reference_normals(result.state, mesh.coordinates);
  result.smooth.inverted = check_validity(*mesh.topology, mesh.coordinates, 0, normals).inverted;
  return result;
}

MotionEquations equations_of(const ResolvedCommand& resolved, const MeshState& state,
                             const CommandResult& moved, const RunOptions& given) {
  const Coordinates& start = moved.state.mesh.coordinates;
  if (moved.state.mesh.topology != state.mesh.topology || !start.alike(state.mesh.coordinates))
    throw UsageError(
        "the moved mesh is not of the nodes and elements of the mesh before the motion");
  RunOptions options = given;
  options.files = resolved.files();
  options.start = &start;
  const Command command = completed(resolved.command(), options);
  const LinearCheckpoint checkpoint([monitor = options.monitor] {
    if (monitor && monitor->cancelled()) throw Cancelled();
  });
  if (is_surface(*state.mesh.topology))
    throw UsageError(
        "what a mesh depends on is known for plane and volume meshes, and this is a surface mesh: "
        "no motion moves its boundary");
  require_dimension(command, state);
  MotionEquations equations;
  const auto prepare = [&](const Command& local, const MeshState& from, const RunOptions& how) {
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.how; }) {
            require_sound(c.how, c.smooth);
            if (!c.how.smooth_after)
              throw UsageError(std::string(c.name) +
                               ": only the boundary moves, so the interior depends on nothing");
            const auto motion = motion_of(c, from);
            const BodyNodes bodies = bodies_of(c, *motion, from);
            RunOptions run = how;
            run.bodies = &bodies;
            // Held layers: as the last correction of their heights left them.
            MeshState corrected = from;
            corrected.vcvs = moved.state.vcvs;
            corrected.roles = moved.state.roles;
            if (moved.smooth.layers_held) run.layer_factors = &moved.smooth.layers_held->factors;
            equations = solve_at_end(corrected, *motion, c.smooth, *how.start, run);
          } else {
            throw UsageError(std::string(c.name) + ": no motion, so the mesh depends on nothing");
          }
        },
        local);
    return CommandResult{from, {}};
  };
  carry_out_near_origin(command, state, options, prepare);
  return equations;
}

}  // namespace winslow
