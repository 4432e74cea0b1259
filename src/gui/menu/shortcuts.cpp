#include "gui/menu/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

/// In a drag digits are numbers, and X, Y, Z axes.
bool means_drag(const Chord& chord) {
  if (chord.control || chord.alt) return false;
  return (chord.key >= GLFW_KEY_0 && chord.key <= GLFW_KEY_9) ||
         (chord.key >= GLFW_KEY_KP_0 && chord.key <= GLFW_KEY_KP_9) ||
         (chord.key >= GLFW_KEY_X && chord.key <= GLFW_KEY_Z);
}

}  // namespace

void handle_shortcuts(const PanelContext& context, bool dragging) {
  for (const UserCommand& command : user_commands()) {
    if (dragging && command.group != CommandGroup::view) continue;
    const auto counts = [dragging](const Chord& chord) {
      return !(dragging && means_drag(chord)) && pressed(chord);
    };
    if (!std::any_of(command.keys.begin(), command.keys.end(), counts)) continue;
    if (why_blocked(command, context).empty()) command.run(context);
  }
}

}  // namespace winslow::gui
