#pragma once

#include <optional>

#include "gui/render/camera.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// Where a magnifier is and what it shows.
struct Inset {
  Camera camera;  ///< its viewport is the inset's place in the framebuffer
  Bounds source;  ///< what it magnifies, in pixels of the framebuffer
  bool pinned = false;
  Bounds frame() const;  ///< the inset, in pixels
};

/// The inset of a view; none if the magnifier is off, or follows a mouse that is elsewhere.
/// mouse: pixels. scale: of the interface.
std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const Vec2& mouse, bool mouse_over, double scale);

/// The factor after so many notches of the wheel.
double turned_factor(double factor, double notches);

}  // namespace winslow::gui
