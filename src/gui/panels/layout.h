#pragma once

#include <imgui.h>

#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// A part of the framebuffer, in pixels.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(float px, float py) const {
    return px >= x && py >= y && px < x + width && py < y + height;
  }
};

/// Where everything is. Sizes that the user drags are in units of the layout (Theme::px).
struct Layout {
  float left_width = 292, right_width = 324, plot_height = 224;  ///< as dragged
  bool plot_empty = false;  ///< it has nothing to show: a strip with its title
  Area menu, toolbar, left, right, plot, viewport, status;
  Area legend;          ///< strip of the legend beside the viewport; empty: it has none
  ColumnState columns;  ///< which are open; a folded one is a strip of icons

  /// What fills the middle of a window.
  enum class Middle { mesh, page };

  /// Largest share of the window's width that both columns together take.
  static constexpr float most_columns = 0.45f;

  /// Divides a framebuffer; columns give way where there is little room, and fold.
  void arrange(int width, int height, const ViewOptions& view, const Theme& theme,
               float menu_height, Middle middle);
  /// A picture of the mesh and its legend alone.
  void arrange_mesh(int width, int height, const ViewOptions& view, const Theme& theme);

 private:
  void arrange_columns(float width, const ViewOptions& view, const Theme& theme);
  void split_off_legend(const ViewOptions& view, const Theme& theme);
};

}  // namespace winslow::gui
