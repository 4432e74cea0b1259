#pragma once

#include <span>

#include "gui/menu/user_command.h"

namespace winslow::gui {

/// What the mouse does in the picture, for the list of keys.
struct Gesture {
  const char* how;
  const char* what;
  MeshKinds serves = all_meshes;
};
std::span<const Gesture> mouse_gestures();

}  // namespace winslow::gui
