#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Draws the bodies that are listed to move together: a click on one selects it, a cross takes it
/// out, and buttons carry all motions out or clear the list. Draws nothing while the list is empty.
void draw_body_list(const PanelContext& context);

/// "12\xC2\xB0 about (0.5, 0), moves by (0.1, 0)".
std::string motion_summary(const RigidMotion& motion, bool in_space);

}  // namespace winslow::gui
