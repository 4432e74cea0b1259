#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/motion/motion.h"
#include "core/strategy/layering.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/vcv_edit.h"

/// Every edit of a mesh is one of these commands. The command line, the studio, undo and recipes
/// all go through execute(); nothing else changes a mesh.
namespace winslow {

/// Smooth the interior, the boundary held.
struct SmoothCommand {
  SmoothOptions smooth;
};

/// Move bodies rigidly, then smooth.
struct MoveCommand {
  std::vector<std::string> markers;
  RigidMotion motion;
  MotionOptions how;
  SmoothOptions smooth;
};

/// Change the shape of bodies, then smooth.
struct DeformCommand {
  std::vector<std::string> markers;
  std::variant<SineDeformation, DisplacementTable> shape;
  MotionOptions how;
  SmoothOptions smooth;
};

/// Put every free node at a random place of the mesh's bounding box (case C of the paper).
struct ScrambleCommand {
  std::uint64_t seed = 1;
};

/// Change virtual control volumes, then smooth towards them, the boundary held. The VCVs stay with
/// the mesh: later commands smooth towards them, too.
struct EditVcvCommand {
  std::vector<VcvEdit> edits;
  SmoothOptions smooth;
};

/// Insert layers of quadrilaterals at walls, or see to those that a mesh has, then smooth.
/// AIAA 2009-1362, cases E and F.
struct LayersCommand : LayerRequest {};

using Command = std::variant<SmoothCommand, MoveCommand, DeformCommand, ScrambleCommand,
                             EditVcvCommand, LayersCommand>;

/// "smooth", "move", "deform", "scramble", "edit_vcv", "layers".
std::string_view command_name(const Command& command);
/// One line for lists and undo menus, e.g. "Rotate flap by -40 deg".
std::string describe(const Command& command);
/// Smoothing options of a command, null if it has none.
SmoothOptions* smooth_options(Command& command);

struct CommandResult {
  MeshState state;
  SmoothResult smooth;  ///< of commands that smooth nothing: converged, no iterations
};

/// Carries out a command on a copy of the state. Throws UsageError for options that are out of
/// range, Cancelled, NumericError; the input state is never touched. A result with inverted
/// elements is returned, not hidden: look at result.smooth.inverted.
CommandResult execute(const Command& command, const MeshState& state,
                      const RunOptions& options = {});

}  // namespace winslow
