#pragma once

#include <imgui.h>

#include "gui/base/screen.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// The legend: in a strip beside the mesh, or on a card over a corner of the view. The mouse drags
/// it from one place to another. While elements are isolated, a line that can be dragged shows the
/// threshold.
class LegendCard {
 public:
  /// The areas available to the legend.
  struct Room {
    Area view;   ///< free part of the mesh's view
    Area strip;  ///< beside it; empty: the legend is over a corner of the view
    Area whole() const;
  };
  /// legend: null while its colours are not known.
  void draw(ImDrawList& list, const PanelContext& context, const Room& room, const Legend* legend);
  /// Handles the mouse; true if the legend uses it, not the mesh. Call it after draw().
  bool take_pointer(const PanelContext& context, const ScreenPoint& mouse, bool pressed);
  /// Called in a frame without a legend.
  void hide();
  /// The box in which the legend was drawn; none: not drawn.
  const std::optional<ScreenBox>& frame() const { return frame_; }
  /// The mouse holds the legend.
  bool held() const { return grip_ || dragging_; }
  /// The mouse could grab the legend, or holds it.
  bool offers_grip() const { return over_ || grip_; }

 private:
  void draw_strip(ImDrawList& list, const PanelContext& context, const Area& strip,
                  const Legend* legend);
  void draw_card(ImDrawList& list, const PanelContext& context, const Area& view,
                 const Legend& legend);
  void draw_bars(ImDrawList& list, const PanelContext& context, const ImVec2& at, float height,
                 const Legend& legend);
  void draw_threshold(ImDrawList& list, const PanelContext& context, const Legend& legend);
  void draw_target(ImDrawList& list, const PanelContext& context) const;
  void drag_threshold(const PanelContext& context, float y) const;
  bool over_bars(const PanelContext& context, const ScreenPoint& mouse) const;
  LegendPlace place_at(const ScreenPoint& mouse) const;

  std::optional<LegendBars> bars_;  // where drawn, if the threshold can be dragged
  ColorScale scale_;                // of their values
  std::optional<ScreenBox> frame_;
  Room room_;  // of the last frame
  bool dragging_ = false, was_pressed_ = false;
  bool over_ = false;                // the mouse could grab the legend
  std::optional<ScreenPoint> grip_;  // where the mouse grabbed it
  bool carried_ = false;             // the mouse moved far enough for a drag
  LegendPlace target_ = LegendPlace::right;
};

}  // namespace winslow::gui
