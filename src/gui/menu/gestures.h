#pragma once

#include <span>

namespace winslow::gui {

/// What the mouse does in the picture, for the list of keys.
struct Gesture {
  const char* how;
  const char* what;
};
std::span<const Gesture> mouse_gestures();

}  // namespace winslow::gui
