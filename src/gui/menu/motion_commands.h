#pragma once

#include "gui/document/actions/actions.h"
#include "gui/menu/user_command.h"

/// Pivots of volume meshes, by the menu and by a right click.
namespace winslow::gui {

/// Where a selection turns: its centre, or what the next click picks.
std::vector<UserCommand> pivots_in_space();

/// What the selection can turn about at a place of a surface.
std::vector<UserCommand> turn_about_place(const PickedPlace& place);

}  // namespace winslow::gui
