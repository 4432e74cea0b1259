#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The row of buttons beneath the menu: the most frequent commands.
class Toolbar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
