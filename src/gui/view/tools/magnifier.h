#pragma once

#include <optional>

#include "gui/render/camera.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// Where a magnifier is and what it shows.
struct Inset {
  Camera camera;     ///< its viewport is the inset's place in the framebuffer
  ScreenBox source;  ///< what it magnifies
  bool pinned = false;
  ScreenBox frame() const { return camera.viewport(); }
};

/// The inset of a view; none if the magnifier is off, or follows a mouse that is elsewhere.
/// scale: of the interface.
std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const ScreenPoint& mouse, bool mouse_over, double scale);

/// The factor after so many notches of the wheel.
double turned_factor(double factor, double notches);

}  // namespace winslow::gui
