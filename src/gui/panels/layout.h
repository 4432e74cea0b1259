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

/// Positions and sizes of all regions. Sizes that the user drags are in units of the layout
/// (Theme::px).
struct Layout {
  float left_width = 292, right_width = 324, plot_height = 224;  ///< as dragged
  bool plot_empty = false;  ///< only a strip with the title is shown
  Area menu, toolbar, left, right, plot, viewport, status;
  Area legend;          ///< strip of the legend beside the viewport; empty: none
  ColumnState columns;  ///< open or folded to a strip of icons

  /// The content of the middle of the window.
  enum class Middle { mesh, page };

  /// Largest share of the window's width that both columns together take.
  static constexpr float most_columns = 0.45f;

  /// Divides a framebuffer; columns shrink or fold if there is little room.
  void arrange(int width, int height, const ViewOptions& view, const Theme& theme,
               float menu_height, Middle middle);
  /// Layout of a picture of only the mesh and its legend.
  void arrange_mesh(int width, int height, const ViewOptions& view, const Theme& theme);

 private:
  void arrange_columns(float width, const ViewOptions& view, const Theme& theme);
  void split_off_legend(const ViewOptions& view, const Theme& theme);
};

}  // namespace winslow::gui
