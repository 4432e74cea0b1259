#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// What to do when no mesh is open.
class WelcomePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
