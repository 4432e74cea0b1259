#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The row of buttons beneath the menu: the most frequent commands.
class Toolbar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

/// One line: the mesh, its quality, what the solver does.
class StatusBar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
