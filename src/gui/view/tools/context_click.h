#pragma once

#include <optional>

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// What lies at a place of the mesh on screen: the boundary within a few pixels or the body around
/// the place, the nearest node within a few more, the element. Hidden markers are not there.
/// scale: of the interface.
PickedPlace pick_place(const Session& session, const View& view, const MarkerLooks& looks,
                       const ScreenPoint& at, double scale);

/// A click of the right button: it pans when it is dragged, and opens a menu where it is not.
class ContextClick {
 public:
  /// The place clicked, in the frame in which the button goes up there.
  std::optional<ScreenPoint> update(const PointerState& pointer, double scale);

 private:
  std::optional<ScreenPoint> press_;
  bool was_down_ = false;
};

}  // namespace winslow::gui
