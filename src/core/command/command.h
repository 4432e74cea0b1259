#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/strategy/layering.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/vcv_edit.h"

/// A client says what is to be done and looks at what came of it:
///
///     winslow::MoveCommand move;
///     move.bodies[0].markers = {"flap"};
///     move.bodies[0].motion.rotate = -20;  // degrees, about the body's own centre
///     const winslow::CommandResult result = winslow::execute(move, state);
///     if (result.smooth.inverted == 0) state = result.state;
///
/// Every edit of a mesh is one of these commands. The command line, the studio, undo and recipes
/// all go through execute(); nothing else changes a mesh.
///
/// TO ADD A COMMAND, write a header with a struct that has `name`, `summary` and `beyond_table`,
/// and `serves_surfaces` and `serves_volumes`, the kinds of meshes that take it besides plane ones,
/// and with option_table(), describe_one() and execute_one() for it, and put the struct into
/// Command. Recipes, the command line, forms and histories follow. Where beyond_table says that it
/// holds more than its option table does (lists, other objects), those three ask for functions of
/// their own: without them it does not compile.
namespace winslow {

/// Smooth the interior, the boundary held.
struct SmoothCommand {
  static constexpr std::string_view name = "smooth";
  static constexpr std::string_view summary = "Smooth the interior, the boundary held";
  static constexpr bool beyond_table = false, serves_surfaces = true, serves_volumes = true;

  SmoothOptions smooth;
};

/// Move bodies rigidly and together, each by a motion of its own, then smooth.
struct MoveCommand {
  static constexpr std::string_view name = "move";
  static constexpr std::string_view summary = "Move bodies rigidly, then smooth";
  static constexpr bool beyond_table = true, serves_surfaces = false, serves_volumes = true;

  std::vector<MovingBody> bodies = std::vector<MovingBody>(1);
  MotionOptions how;
  SmoothOptions smooth;
};

/// Change the shape of bodies, then smooth.
struct DeformCommand {
  static constexpr std::string_view name = "deform";
  static constexpr std::string_view summary = "Change the shape of bodies, then smooth";
  static constexpr bool beyond_table = true, serves_surfaces = false, serves_volumes = true;

  std::vector<std::string> markers;
  std::variant<SineDeformation, DisplacementTable> shape;
  MotionOptions how;
  SmoothOptions smooth;
};

/// Put every free node at a random place of the mesh's bounding box (case C of the paper).
struct ScrambleCommand {
  static constexpr std::string_view name = "scramble";
  static constexpr std::string_view summary =
      "Put every interior node at a random place of the mesh's bounding box: a test of smoothing "
      "(needs --allow-inverted to be written)";
  static constexpr bool beyond_table = false, serves_surfaces = true, serves_volumes = true;

  std::uint64_t seed = 1;
};

/// Change virtual control volumes, then smooth towards them, the boundary held. The VCVs stay with
/// the mesh: later commands smooth towards them, too.
struct EditVcvCommand {
  static constexpr std::string_view name = "edit_vcv";
  static constexpr std::string_view summary = "Change virtual control volumes, then smooth";
  static constexpr bool beyond_table = true, serves_surfaces = true, serves_volumes = true;

  std::vector<VcvEdit> edits;
  SmoothOptions smooth;
};

/// Insert layers of quadrilaterals at walls, or see to those that a mesh has, then smooth.
/// AIAA 2009-1362, cases E and F.
struct LayersCommand : LayerRequest {
  static constexpr std::string_view name = "layers";
  static constexpr std::string_view summary =
      "Insert viscous layers at walls: quadrilaterals of wanted heights";
  static constexpr bool beyond_table = true, serves_surfaces = false, serves_volumes = false;
};

using Command = std::variant<SmoothCommand, MoveCommand, DeformCommand, ScrambleCommand,
                             EditVcvCommand, LayersCommand>;

/// "smooth", "move", ...
std::string_view command_name(const Command& command);
/// One of each kind, as their structs make them, in the order of Command.
std::vector<Command> all_commands();
/// One line for lists and undo menus, e.g. "Rotate flap by -40 deg".
std::string describe(const Command& command);
/// Smoothing options of a command, null if it has none.
SmoothOptions* smooth_options(Command& command);
const SmoothOptions* smooth_options(const Command& command);
/// A motion leads through valid meshes from its start to its end, so that limits of the quality can
/// be kept on the way: no steps are asked for, the mesh is smoothed, and not by a fixed point.
bool follows_path(const MotionOptions& how, const SmoothOptions& smooth);
/// True of a command that is there to change the heights of cells at walls.
bool asks_for_heights(const Command& command);
/// Markers that a command names.
std::vector<std::string> markers_of(const Command& command);

/// The command with the pivot that a rotation leaves to its body: body_centre() of all nodes of the
/// body's markers. `states`: the meshes that it is about, several for the zones of a file, in which
/// a body then turns as one. Markers that none has are for execute() to refuse.
Command with_pivot(Command command, std::span<const MeshState* const> states);

/// A command with all that it asks of files. A command that asks for nothing, as most do, becomes
/// one by itself; of others io::resolve_files() makes one, or who has the surface:
///
///     smooth.smooth.slide.reference = "hull";  // any name
///     const winslow::ResolvedCommand ready(smooth, {.reference = surface});
class ResolvedCommand {
 public:
  /// Throws UsageError for a command that asks for what is not in `files`, and for a surface that
  /// it does not name.
  ResolvedCommand(Command command, SlideFiles files = {});
  template <class Kind>
  requires(std::constructible_from<Command, Kind> && !std::same_as<Kind, Command> &&
           !std::same_as<Kind, ResolvedCommand>)
      ResolvedCommand(Kind command, SlideFiles files = {})
      : ResolvedCommand(Command(std::move(command)), std::move(files)) {}

  const Command& command() const { return command_; }
  const SlideFiles& files() const { return files_; }

 private:
  Command command_;
  SlideFiles files_;
};

struct CommandResult {
  MeshState state;
  SmoothResult smooth;  ///< of commands that smooth nothing: converged, no iterations
};

/// Carries out a command on a copy of the state, a mesh far from the origin in coordinates near it
/// (LocalFrame). Throws UsageError for options that are out of
/// range, Cancelled, NumericError; the input state is never touched. A result with inverted
/// elements is returned, not hidden: look at result.smooth.inverted.
CommandResult execute(const ResolvedCommand& command, const MeshState& state,
                      const RunOptions& options = {});

}  // namespace winslow
