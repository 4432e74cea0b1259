#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Share of a row that labels take in the panel of the motion.
inline constexpr float motion_label_share = 0.385f;

/// In how many steps bodies go to their places; of either dimension.
void draw_motion_steps(const PanelContext& context);

}  // namespace winslow::gui
