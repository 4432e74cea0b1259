#pragma once

#include <imgui.h>

#include "gui/base/screen.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// The legend: in a strip beside the mesh, or on a card over one of its corners. The mouse drags it
/// from one to another. Where elements are isolated, the threshold is a line in it that the mouse
/// drags.
class LegendCard {
 public:
  /// Where there is room for it.
  struct Room {
    Area view;   ///< of the mesh that is free
    Area strip;  ///< beside it; empty: the legend lies over a corner of the view
    Area whole() const;
  };
  /// legend: null: its colours are not known yet.
  void draw(ImDrawList& list, const PanelContext& context, const Room& room, const Legend* legend);
  /// Takes the mouse; true if it is the legend's and not the mesh's. Call it after draw().
  bool take_pointer(const PanelContext& context, const ScreenPoint& mouse, bool pressed);
  /// No legend is drawn in this frame.
  void hide();
  /// Where it was drawn; none: it is not.
  const std::optional<ScreenBox>& frame() const { return frame_; }
  /// The mouse has taken hold of it.
  bool held() const { return grip_ || dragging_; }
  /// The mouse would take hold of it, or has.
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

  std::optional<LegendBars> bars_;  // where they were drawn, if a threshold can be dragged
  ColorScale scale_;                // of their values
  std::optional<ScreenBox> frame_;
  Room room_;  // of the last frame
  bool dragging_ = false, was_pressed_ = false;
  bool over_ = false;                // the mouse would take hold of the legend
  std::optional<ScreenPoint> grip_;  // where it did
  bool carried_ = false;             // and has gone far enough to carry it elsewhere
  LegendPlace target_ = LegendPlace::right;
};

}  // namespace winslow::gui
