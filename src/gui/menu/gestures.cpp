#include "gui/menu/gestures.h"

#include <array>

namespace winslow::gui {

std::span<const Gesture> mouse_gestures() {
  constexpr MeshKinds plane = plane_meshes, volume = volume_meshes, space = meshes_in_space;
  constexpr MeshKinds surface{MeshKind::surface};
  static constexpr std::array<Gesture, 41> gestures{
      {{"Click a body", "select it", plane},
       {"Ctrl or Shift + click", "add to the selection"},
       {"Double click a body", "zoom to it, also in the list", plane},
       {"Drag a body", "move it; the mesh follows", plane},
       {"Drag an arrow", "move along x or y", plane},
       {"Drag the ring", "rotate about the pivot", plane},
       {"Drag the pin", "put the pivot elsewhere", plane},
       {"... with Ctrl", "snap to grid, 5 degrees, nodes", plane},
       {"... with Shift", "a tenth of the speed", plane},
       {"X, Y in a drag", "keep to that axis, or set free", plane},
       {"30 Enter in a drag", "by just 30; moving: x Tab y", plane},
       {"Enter, Esc in a drag", "accept, cancel", plane},
       {"Drag a node (E)", "change the shape", plane},
       {"... with the wheel", "how far it fades", plane},
       {"Shift + click a node (E)", "take the arc up to it", plane},
       {"Drag elsewhere", "pan; also middle or right button", plane},
       {"Right click", "what can be done there"},
       {"Alt + click a node", "inspect it; in tab VCV a click"},
       {"Wheel", "zoom at the cursor"},
       {"Ctrl + right drag", "zoom to a box"},
       {"Click a surface", "select its marker", volume},
       {"Click a cut", "its element", volume},
       {"Click the surface", "the element there", surface},
       {"Double click a surface", "zoom to it", volume},
       {"Left drag", "turn about what is there (T: freely)", space},
       {"Alt + click", "the node there", space},
       {"Middle, right, Shift + left", "pan", space},
       {"Drag an arrow", "move along it", volume},
       {"Drag a small square", "move in its plane", volume},
       {"Drag a ring", "turn about its axis", volume},
       {"Drag the disc", "move across the view", volume},
       {"... with Ctrl, Shift", "in steps, slowly", volume},
       {"X, Y, Z in a drag", "that axis alone, or back", volume},
       {"30 Enter in a drag", "by just 30; Tab: the next", volume},
       {"Drag a node (E)", "change the shape", volume},
       {"Shift + click a node or face (E)", "hold it as well", volume},
       {"Drag a cut's arrow", "move the cut", volume},
       {"Drag the arrow's ball", "turn the cut", volume},
       {"Esc in a drag", "as it was before", space},
       {"Drag the legend", "to another side or corner"},
       {"Line in the legend", "threshold of what is isolated"}}};
  return gestures;
}

}  // namespace winslow::gui
