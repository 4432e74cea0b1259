#include "gui/menu/gestures.h"

#include <array>

namespace winslow::gui {

std::span<const Gesture> mouse_gestures() {
  static constexpr std::array<Gesture, 22> gestures{
      {{"Click a body", "select it"},
       {"Ctrl or Shift + click", "add to the selection"},
       {"Double click a body", "zoom to it, also in the list"},
       {"Drag a body", "move it; the mesh follows"},
       {"Drag an arrow", "move along x or y"},
       {"Drag the ring", "rotate about the pivot"},
       {"Drag the pin", "put the pivot elsewhere"},
       {"... with Ctrl", "snap to grid, 5 degrees, nodes"},
       {"... with Shift", "a tenth of the speed"},
       {"X, Y in a drag", "keep to that axis, or set free"},
       {"30 Enter in a drag", "by just 30; moving: x Tab y"},
       {"Enter, Esc in a drag", "accept, cancel"},
       {"Drag a node (E)", "change the shape"},
       {"... with the wheel", "how far it fades"},
       {"Shift + click a node (E)", "take the arc up to it"},
       {"Drag elsewhere", "pan; also middle or right button"},
       {"Right click", "what can be done there"},
       {"Alt + click a node", "inspect it; in tab VCV a click"},
       {"Wheel", "zoom at the cursor"},
       {"Ctrl + right drag", "zoom to a box"},
       {"Drag the legend", "to another side or corner"},
       {"Line in the legend", "threshold of what is isolated"}}};
  return gestures;
}

}  // namespace winslow::gui
