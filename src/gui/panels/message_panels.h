#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// What the state of the mesh calls for, in a strip above it: inverted elements, not converged.
class BannerPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
  static constexpr float side_padding = 14;  ///< of the strip, at scale 1
  /// Height that the strip needs at a width, in pixels: one line, or more where there is no room.
  static float height(const PanelContext& context, float width);
};

/// The question or the error that waits for an answer, as a dialog.
class PromptPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
