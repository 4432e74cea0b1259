#pragma once

#include <optional>

#include "core/types.h"

namespace winslow::gui {

/// A node or an element of the open mesh.
struct MeshItem {
  enum class Kind { node, element };
  Kind kind = Kind::element;
  Index id = 0;

  bool operator==(const MeshItem&) const = default;
};

/// What the view is doing at the moment; unlike ViewOptions nothing that one would keep.
struct ViewState {
  std::optional<MeshItem> focus;  ///< what was gone to: highlighted and described
  bool go_to_wanted = false;      ///< the field "Go to" takes the keyboard in this frame
  bool box_zoom_armed = false;    ///< the next drag draws the box to zoom to
  bool can_go_back = false;       ///< to an earlier view
  bool can_go_forward = false;
};

}  // namespace winslow::gui
