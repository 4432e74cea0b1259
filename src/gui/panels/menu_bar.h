#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The menu bar, with the keys of each command.
class MenuBar : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_file(const PanelContext& context);
  void draw_edit(const PanelContext& context);
  void draw_solver(const PanelContext& context);
  void draw_view(const PanelContext& context);
};

}  // namespace winslow::gui
