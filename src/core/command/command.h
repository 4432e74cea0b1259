#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/layers/layer_plan.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"
#include "core/outer/smooth_options.h"
#include "core/vcv/vcv_edit.h"
#include "core/vcv/virtual_control_volumes.h"

/// Every edit of a mesh is one of these commands. The command line, the studio, undo and recipes
/// all go through execute(); nothing else changes a mesh.
///
/// TO ADD A COMMAND, write a header with a struct that has `name`, `summary` and `beyond_table`,
/// and with option_table(), describe_one() and execute_one() for it, and put the struct into
/// Command. Recipes, the command line, forms and histories follow. Where beyond_table says that it
/// holds more than its option table does (lists, other objects), those three ask for functions of
/// their own: without them it does not compile.
namespace winslow {

/// Smooth the interior, the boundary held.
struct SmoothCommand {
  static constexpr std::string_view name = "smooth";
  static constexpr std::string_view summary = "Smooth the interior, the boundary held";
  static constexpr bool beyond_table = false;

  SmoothOptions smooth;
};

/// How a boundary motion is carried out.
struct MotionOptions {
  /// Steps in which the boundary moves, each followed by smoothing; 1: at once, as in the paper;
  /// 0: follow the path through valid meshes in steps as long as they can be (fixed-point
  /// iteration: at once; if that ends tangled, again in 8 and then in 32 steps).
  int increments = 0;
  bool smooth_after = true;  ///< false: move the boundary only
};

/// Move bodies rigidly, then smooth.
struct MoveCommand {
  static constexpr std::string_view name = "move";
  static constexpr std::string_view summary = "Move bodies rigidly, then smooth";
  static constexpr bool beyond_table = false;

  std::vector<std::string> markers;
  RigidMotion motion;
  MotionOptions how;
  SmoothOptions smooth;
};

/// Change the shape of bodies, then smooth.
struct DeformCommand {
  static constexpr std::string_view name = "deform";
  static constexpr std::string_view summary = "Change the shape of bodies, then smooth";
  static constexpr bool beyond_table = true;

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
  static constexpr bool beyond_table = false;

  std::uint64_t seed = 1;
};

/// Change virtual control volumes, then smooth towards them, the boundary held. The VCVs stay with
/// the mesh: later commands smooth towards them, too.
struct EditVcvCommand {
  static constexpr std::string_view name = "edit_vcv";
  static constexpr std::string_view summary = "Change virtual control volumes, then smooth";
  static constexpr bool beyond_table = true;

  std::vector<VcvEdit> edits;
  SmoothOptions smooth;
};

/// What is done about layers.
enum class LayerTask {
  insert,   ///< new layers: the one command that changes the connectivity
  respace,  ///< the layers that the mesh has get other heights
  hold      ///< the layers that the mesh has keep their heights from here on
};

/// Insert layers of quadrilaterals at walls, or take those that a mesh has in hand, then smooth.
/// AIAA 2009-1362, cases E and F.
struct LayersCommand {
  static constexpr std::string_view name = "layers";
  static constexpr std::string_view summary =
      "Insert viscous layers at walls: quadrilaterals of wanted heights";
  static constexpr bool beyond_table = true;

  LayerTask task = LayerTask::insert;
  LayerOptions layers;
  /// Hold the wanted heights, through the VCVs; false (insert only): smooth the new connectivity as
  /// it is.
  bool control = true;
  double tolerance = 2e-3;   ///< relative error of any height above which the VCVs are corrected
  int most_corrections = 8;  ///< smoothing runs after the first
  SmoothOptions smooth;
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
/// Markers that a command names.
std::vector<std::string> markers_of(const Command& command);

/// What commands act on.
struct MeshState {
  Mesh mesh;
  std::shared_ptr<const VirtualControlVolumes> vcv;
  /// Layers that were inserted; if held, their spacing is kept whatever moves. Null: none.
  std::shared_ptr<const LayerStack> layers = nullptr;
};
/// A state with the paper's VCVs: equal angles, unit edges.
MeshState make_state(Mesh mesh);

struct CommandResult {
  MeshState state;
  SmoothResult smooth;  ///< of commands that smooth nothing: converged, no iterations
};

class SmoothingWorkspace;  // prepared solvers, kept between commands on one topology

struct ExecuteOptions {
  SolverMonitor* monitor = nullptr;
  /// A mesh to start from instead of the state's own (all nodes). For dragging: the solution is the
  /// same, only nearer. Paths begin at its boundary where it is valid; all else uses the interior.
  const Coordinates* start = nullptr;
  SmoothingWorkspace* workspace = nullptr;  ///< null: a new one for this call
};

/// Carries out a command on a copy of the state. Throws UsageError for senseless options,
/// Cancelled, NumericError; the input state is never touched. A result with inverted elements is
/// returned, not hidden: look at result.smooth.inverted.
CommandResult execute(const Command& command, const MeshState& state,
                      const ExecuteOptions& options = {});

}  // namespace winslow
