#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Changes of shape: by hand, or a sine along the body with a preview of its outline.
class ShapePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_by_hand(const PanelContext& context);
  void draw_sine(const PanelContext& context);
  bool draw_fields(bool in_space);
  bool draw_axes(bool in_space);

  SineDeformation typed_;
  bool preview_ = true;
};

}  // namespace winslow::gui
