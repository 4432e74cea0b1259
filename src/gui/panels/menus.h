#pragma once

#include "gui/document/actions/actions.h"
#include "gui/menu/panel_context.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

/// A command, or a submenu of commands, as an entry of the open menu. Scripts find it as
/// "menu/ID".
void draw_menu_entry(const UserCommand& command, const PanelContext& context);

/// The menu bar: the table of commands (gui/menu/user_command.h), a menu a group.
class MenuBar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

/// The menu of a right click: what can be done with the body, the node and the element there.
class ContextMenu : public Panel {
 public:
  void draw(const PanelContext& context) override;
  /// Comes up beside the mouse.
  void open(const PickedPlace& place);

 private:
  PickedPlace place_;
  std::shared_ptr<const Topology> topology_;  ///< that the numbers of the place belong to
  bool wanted_ = false;
};

}  // namespace winslow::gui
