#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Share of a row that labels take in the panel of the motion.
inline constexpr float motion_label_share = 0.385f;

/// In how many steps bodies go to their places; of either dimension.
void draw_motion_steps(const PanelContext& context);

/// Limits of quality, of either dimension: they hold for every motion and deformation from here on,
/// dragged or typed.
void draw_quality_limits(const PanelContext& context);

}  // namespace winslow::gui
