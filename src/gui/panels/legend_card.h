#pragma once

#include <imgui.h>

#include <optional>

#include "gui/base/screen.h"
#include "gui/panels/layout.h"
#include "gui/panels/panel.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// The legend in a corner of the viewport. Where elements are isolated, the threshold is a line in
/// it that the mouse drags.
class LegendCard {
 public:
  /// area: of the viewport that is free.
  void draw(ImDrawList& list, const PanelContext& context, const Area& area, const Legend& legend);
  /// Takes the mouse; true if it is the legend's and not the mesh's. Call it after draw().
  bool take_pointer(const PanelContext& context, const ScreenPoint& mouse, bool pressed);
  /// No legend is drawn in this frame.
  void hide() { bars_.reset(); }

 private:
  void draw_threshold(ImDrawList& list, const PanelContext& context, const Legend& legend);

  std::optional<LegendBars> bars_;  // where they were drawn, if a threshold can be dragged
  ColorScale scale_;                // of their values
  bool dragging_ = false, was_pressed_ = false;
};

}  // namespace winslow::gui
