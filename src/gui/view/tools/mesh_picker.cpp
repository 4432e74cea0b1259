#include "gui/view/tools/mesh_picker.h"

namespace winslow::gui {

void MeshPicker::look(const PointerFrame& frame, bool handled) {
  found_ = {};
  if (frame.pointer.over)
    find(frame, handled);
  else
    forget();
  if (found_.node != told_node_) frame.actions.emplace_back(action::HoverNode{found_.node});
  told_node_ = found_.node;
  if (found_.markers != told_markers_)
    frame.actions.emplace_back(action::HoverMarkers{found_.markers});
  told_markers_ = found_.markers;
}

}  // namespace winslow::gui
