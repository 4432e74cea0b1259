#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "core/command/command.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/settings/option_edits.h"

/// The solver: what it carries out, and how. Carried out by Jobs.
namespace winslow::gui::action {

struct RunSmooth {};
struct Scramble {
  std::uint64_t seed = 1;
};
struct PauseSolver {};
struct ResumeSolver {};
struct StepSolver {
  int count = 1;
};
struct CancelSolver {};
struct EditSmoothOptions {
  OptionEdit<SmoothOptions> edit;
};
struct EditMotionOptions {
  OptionEdit<MotionOptions> edit;
};
/// Has the nodes of two markers move together, as periodic sides, or those of `first` with none (no
/// second): in every run from here on.
struct PairMarkers {
  std::string first;
  std::optional<std::string> second;
};
/// Has a node of the boundary stay, or slide, in every run from here on, whatever was found of it.
/// Undo takes it back.
struct OverrideNode {
  Index node = 0;
  NodeOverride to = NodeOverride::none;
};
/// Takes back what was last told to a node at this mesh, or tells it again.
struct StepOverride {
  bool again = false;
};
/// The surface in a file, for nodes to slide on in every run from here on instead of the mesh's
/// own. It is read first; a file that cannot be read changes nothing.
struct ChooseReference {
  std::filesystem::path file;  ///< empty: none, the mesh's own
};
/// How fast the outer iterations of the direct method go by.
struct SetPace {
  double iterations_per_second = 0;  ///< 0: as fast as they come
};
/// The solver waits after every iteration until this comes again: someone records them all.
struct FollowSolver {
  bool on = true;
};
/// Any command, as a recipe has it.
struct RunCommand {
  Command command;
  bool paused = false;  ///< wait before the first iteration
  /// What it does to a mesh that has no changes is no work of the user's, which would have to be
  /// saved: a step of a demo.
  bool shown_only = false;
};
/// Carries out a command of the history again, from the mesh it found, to be watched; paused at
/// first. The history stays what it is.
struct RerunStep {
  std::size_t position = 1;  ///< as History::command()
};
/// Layers of the mesh, planned and shown but not inserted; none: no more.
struct PreviewLayers {
  std::optional<LayerOptions> options;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using JobAction = std::variant<action::RunSmooth, action::Scramble, action::PauseSolver,
                               action::ResumeSolver, action::StepSolver, action::CancelSolver,
                               action::EditSmoothOptions, action::EditMotionOptions,
                               action::PairMarkers, action::OverrideNode, action::StepOverride,
                               action::ChooseReference, action::SetPace, action::FollowSolver,
                               action::RunCommand, action::RerunStep, action::PreviewLayers>;

}  // namespace winslow::gui
