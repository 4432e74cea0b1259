#pragma once

#include "gui/document/actions/actions.h"
#include "gui/menu/user_command.h"

/// What a right click offers. The commands emit the same actions as menus and panels do; those that
/// the menus have as they are come from their table.
namespace winslow::gui {

/// What lies there, as the head of a menu: "flap", "Node 12  x 0.5  y 0.1".
struct ContextPart {
  std::string title;
  std::vector<UserCommand> commands;
};
/// The body or marker first, then the node, the element, and last what is of the view.
std::vector<ContextPart> context_parts(const PanelContext& context, const PickedPlace& place);

}  // namespace winslow::gui
