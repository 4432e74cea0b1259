#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Moves the selected bodies of a volume mesh by numbers.
class SpaceMotionPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_fields();
  void draw_axis();
  static void draw_pivot(const PanelContext& context);
  void preview(const PanelContext& context, bool wanted) const;

  SpaceMotion typed_;  // the pivot is the session's
};

}  // namespace winslow::gui
