#include "gui/commands/gestures.h"

#include <array>

namespace winslow::gui {

std::span<const Gesture> mouse_gestures() {
  static constexpr std::array<Gesture, 12> gestures{
      {{"Click a body", "select it"},
       {"Ctrl or Shift + click", "add to the selection"},
       {"Drag a body", "move it; the mesh follows"},
       {"... with Shift", "keep to one axis"},
       {"Drag the ring", "rotate about the pivot"},
       {"... with Shift", "in steps of 5 degrees"},
       {"Drag the pivot", "put it elsewhere"},
       {"Drag elsewhere", "pan; also middle or right button"},
       {"Alt + click a node", "inspect it; a click will do while the tab VCV is open"},
       {"Wheel", "zoom at the cursor"},
       {"Ctrl + right drag", "zoom to a box"},
       {"Line in the legend", "drag: threshold of what is isolated"}}};
  return gestures;
}

}  // namespace winslow::gui
