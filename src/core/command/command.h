#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/node_table.h"
#include "core/strategy/layering.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/vcv_edit.h"

/// A client describes an edit as a command, executes it and reads the result:
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
/// TO ADD A COMMAND, write a header with a struct that has `name`, `summary`, `beyond_table` and
/// `serves_surfaces` (whether surface meshes accept the command, as plane and volume meshes do).
/// Add option_table(), describe_one() and execute_one() for the struct, and the struct to Command.
/// Recipes, the command line, forms and histories then support it. If beyond_table is true, the
/// struct has members that its option table lacks (lists, other objects). Recipes, the command line
/// and forms then need functions for these members: without them the program does not compile.
namespace winslow {

/// Smooths the interior and holds the boundary.
struct SmoothCommand {
  static constexpr std::string_view name = "smooth";
  static constexpr std::string_view summary = "Smooth the interior, the boundary held";
  static constexpr bool beyond_table = false, serves_surfaces = true;

  SmoothOptions smooth;
};

/// Moves bodies rigidly and simultaneously, each by its own motion. The mesh follows: by default
/// its elements keep the shapes that they have in the reference mesh (kept_shapes.h).
struct MoveCommand {
  static constexpr std::string_view name = "move";
  static constexpr std::string_view summary = "Move bodies rigidly, and the mesh with them";
  static constexpr bool beyond_table = true, serves_surfaces = false;

  std::vector<MovingBody> bodies = std::vector<MovingBody>(1);
  MotionOptions how;
  SmoothOptions smooth;
};

/// Changes the shape of bodies, or prescribes single nodes on the boundary and inside. The mesh
/// follows as in MoveCommand. Tables of nodes need no markers (node_table.h).
struct DeformCommand {
  static constexpr std::string_view name = "deform";
  static constexpr std::string_view summary =
      "Change the shape of bodies, and move the mesh with them";
  static constexpr bool beyond_table = true, serves_surfaces = false;

  std::vector<std::string> markers;
  std::variant<SineDeformation, DisplacementTable, PositionTable> shape;
  MotionOptions how;
  SmoothOptions smooth;
};

/// Moves every free node to a random position in the mesh's bounding box (case C of the paper).
/// Nodes in which regions meet stay: smoothing holds them.
struct ScrambleCommand {
  static constexpr std::string_view name = "scramble";
  static constexpr std::string_view summary =
      "Put every interior node at a random place of the mesh's bounding box: a test of smoothing "
      "(needs --allow-inverted to be written)";
  static constexpr bool beyond_table = false, serves_surfaces = true;

  std::uint64_t seed = 1;
};

/// Changes virtual control volumes, then smooths towards them with the boundary held. The VCVs stay
/// with the mesh: later commands smooth towards them, too.
struct EditVcvCommand {
  static constexpr std::string_view name = "edit_vcv";
  static constexpr std::string_view summary = "Change virtual control volumes, then smooth";
  static constexpr bool beyond_table = true, serves_surfaces = true;

  std::vector<VcvEdit> edits;
  SmoothOptions smooth;
};

/// Inserts layers of quadrilaterals at walls, or respaces or holds existing layers, then smooths.
/// In a volume mesh it can only hold layers. AIAA 2009-1362, cases E and F.
struct LayersCommand : LayerRequest {
  static constexpr std::string_view name = "layers";
  static constexpr std::string_view summary =
      "Insert viscous layers at walls: quadrilaterals of wanted heights";
  static constexpr bool beyond_table = true, serves_surfaces = false;
};

using Command = std::variant<SmoothCommand, MoveCommand, DeformCommand, ScrambleCommand,
                             EditVcvCommand, LayersCommand>;

/// "smooth", "move", ...
std::string_view command_name(const Command& command);
/// One default-constructed command of each kind, in the order of Command.
std::vector<Command> all_commands();
/// One line for lists and undo menus, e.g. "Rotate flap by -40 deg".
std::string describe(const Command& command);
/// Smoothing options of a command, null if it has none.
SmoothOptions* smooth_options(Command& command);
const SmoothOptions* smooth_options(const Command& command);
/// True if the motion follows a path of valid meshes, on which quality limits can be kept: with
/// increments 0, smoothing, and no fixed point.
bool follows_path(const MotionOptions& how, const SmoothOptions& smooth);
/// True for a command whose purpose is to change the heights of cells at walls.
bool asks_for_heights(const Command& command);
/// True for motions, scrambles and commands that only hold layers, which leave the reference mesh
/// of a state as it is (MeshState::reference). The result of every other command is the next
/// reference mesh.
bool keeps_reference(const Command& command);
/// Markers that a command names.
std::vector<std::string> markers_of(const Command& command);

/// Returns the command with a pivot for each rotation that has none: body_centre() of all nodes of
/// the body's markers. `states`: the meshes to which the command applies; across the zones of a
/// file a body rotates as one. execute() refuses markers that no mesh has.
Command with_pivot(Command command, std::span<const MeshState* const> states);

/// A command with the contents of all files that it refers to. Most commands refer to no file and
/// convert implicitly. For the others io::resolve_files() makes one, or a client that has the
/// surface:
///
///     smooth.smooth.slide.reference = "hull";  // any name
///     const winslow::ResolvedCommand ready(smooth, {.reference = surface});
class ResolvedCommand {
 public:
  /// Throws UsageError if the command refers to a file that `files` lacks, or if `files` has a
  /// surface that the command does not name.
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
  SmoothResult smooth;  ///< for commands without smoothing: converged, no iterations
};

/// Executes a command on a copy of the state. A mesh far from the origin is shifted to near the
/// origin for the computation (LocalFrame). Throws UsageError for options that are out of range,
/// Cancelled, NumericError; the input state is never changed. A result with inverted elements is
/// returned, not hidden: look at result.smooth.inverted.
CommandResult execute(const ResolvedCommand& command, const MeshState& state,
                      const RunOptions& options = {});

}  // namespace winslow
