#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Share of a row that labels take in the panel of the motion.
constexpr float motion_label_share = 0.385f;

/// Rows for the region outside which nothing moves (SmoothOptions::keep_outside): none, a circle
/// about the selection, a box around it.
void draw_keep_outside(const PanelContext& context);

}  // namespace winslow::gui
