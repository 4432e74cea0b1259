#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The row of buttons beneath the menu.
class Toolbar : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_files(const PanelContext& context);
  void draw_solver(const PanelContext& context);
};

}  // namespace winslow::gui
