#pragma once

#include <cstddef>
#include <optional>

#include "core/vcv/vcv_edit.h"

namespace winslow::gui {

/// What the mouse does in a picture of a VCV, of the plane or of space.
struct VcvPlotOutcome {
  std::optional<std::size_t> hovered;  ///< neighbour under the mouse
  std::optional<VcvEdit> edit;         ///< the VCV as it is dragged
  bool ended = false;                  ///< the drag is over
  bool cancelled = false;              ///< by Esc
};

}  // namespace winslow::gui
