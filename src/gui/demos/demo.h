#pragma once

#include "core/command/command.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// A step of a demo: its command and view, and the text of its card.
struct DemoStep {
  std::string title, text;
  std::vector<std::string> select = {};            ///< markers
  std::optional<Command> command = {};             ///< carried out at the start of the step
  bool afresh = false;                             ///< the command acts on the mesh as opened
  std::optional<std::array<double, 4>> view = {};  ///< shown at the start: x0, y0, x1, y1
  bool regular = false;  ///< the command aims at regular elements, regardless of the panels
  std::optional<SpaceLook> space = {};  ///< view of a volume mesh, shown at the start
  /// The command uses the paper's pointwise form and its fixed point with these angles, regardless
  /// of the panels.
  std::optional<VcvKind> pointwise_over = {};
};

/// A case of the paper, or a volume mesh, played step by step on a bundled mesh.
struct Demo {
  std::string id;  ///< the paper's letter, or one of the following letters
  std::string title;
  std::string mesh;  ///< file below the folder of the bundled meshes
  std::vector<DemoStep> steps;
};

/// All demos; those on volume meshes are last. TO ADD ONE, add a function to demo.cpp.
const std::vector<Demo>& demos();
/// The demo with that id; null: none.
const Demo* find_demo(const std::string& id);

}  // namespace winslow::gui
