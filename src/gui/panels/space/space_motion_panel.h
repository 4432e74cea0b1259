#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Moves the selected bodies of a volume mesh by numbers.
class SpaceMotionPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_fields(const PanelContext& context, bool live);
  static void draw_pivot(const PanelContext& context);
  static void draw_sources(const PanelContext& context);
  void preview(const PanelContext& context, bool wanted) const;

  SpaceMotion typed_;  // pivot and axis are the session's
};

}  // namespace winslow::gui
