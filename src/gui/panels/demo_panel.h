#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The card of the demo being played: what happens, what to look at, the numbers as they are now.
class DemoPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
  /// What the card needs at a width, in pixels.
  static float height(const PanelContext& context, float width);
};

}  // namespace winslow::gui
