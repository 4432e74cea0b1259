#pragma once

#include <imgui.h>

#include "gui/settings/view_options.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// A part of the framebuffer, in pixels.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// Where everything is. Sizes that the user drags are in units of the layout (Theme::px).
struct Layout {
  float left_width = 292, right_width = 324, plot_height = 224;  ///< as dragged
  bool plot_empty = false;  ///< it has nothing to show: a strip with its title
  Area menu, toolbar, left, right, plot, viewport, status;

  /// Divides a framebuffer; panels give way where there is little room.
  void arrange(int width, int height, const ViewOptions& view, const Theme& theme,
               float menu_height);
};

}  // namespace winslow::gui
