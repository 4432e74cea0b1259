#pragma once

#include "gui/menu/panel_context.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

/// All keys and what the mouse does, over everything else; Esc or any click closes it.
class HelpPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

  void open() { wanted_ = true; }

 private:
  bool wanted_ = false;
};

/// What the mouse does in the picture, for the list of keys.
struct Gesture {
  const char* how;
  const char* what;
  MeshKinds serves = all_meshes;
};
std::span<const Gesture> mouse_gestures();

}  // namespace winslow::gui
