#pragma once

#include "core/command/command.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// What happens in a step of a demo, and what a card says about it meanwhile.
struct DemoStep {
  std::string title, text;
  std::vector<std::string> select = {};            ///< markers
  std::optional<Command> command = {};             ///< carried out when the step begins
  bool afresh = false;                             ///< the command acts on the mesh as opened
  std::optional<std::array<double, 4>> view = {};  ///< shown when it begins: x0, y0, x1, y1
  bool regular = false;  ///< the command strives for regular elements, whatever the panels say
  std::optional<SpaceLook> space = {};  ///< the same of a volume mesh
  /// The command is the paper's pointwise form, by its fixed point over these angles, whatever the
  /// panels say.
  std::optional<VcvKind> pointwise_over = {};
};

/// A case of the paper, or a volume mesh, played step by step on a bundled mesh.
struct Demo {
  std::string id;  ///< the paper's letter, or the next ones
  std::string title;
  std::string mesh;  ///< file below the folder of the bundled meshes
  std::vector<DemoStep> steps;
};

/// All demos, those on volume meshes last. TO ADD ONE, add a function to demo.cpp.
const std::vector<Demo>& demos();
/// Null if there is none of that id.
const Demo* find_demo(const std::string& id);

}  // namespace winslow::gui
