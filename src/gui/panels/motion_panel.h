#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Moves the selected bodies by numbers; shows the numbers of a drag.
class MotionPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_fields(const PanelContext& context, bool live);
  void preview(const PanelContext& context, bool wanted) const;
  void draw_pivot(const PanelContext& context);

  RigidMotion typed_;  // rotate and translate; the pivot is the session's
};

}  // namespace winslow::gui
