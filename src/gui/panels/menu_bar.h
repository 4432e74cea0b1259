#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The menu bar: the table of commands (gui/menu/user_command.h), a menu a group.
class MenuBar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
