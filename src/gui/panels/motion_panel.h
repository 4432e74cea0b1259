#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Moves the selected bodies by numbers; shows the numbers of a drag.
class MotionPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_fields(const PanelContext& context, bool live);
  static void draw_pivot(const PanelContext& context);
  static void draw_axis_and_pivot(const PanelContext& context);
  static void draw_sources(const PanelContext& context);
  RigidMotion asked(const Session& session) const;
  void preview(const PanelContext& context, bool wanted) const;

  // As typed; pivot and axis are the session's.
  double rotate_ = 0;  // degrees
  Vec3 translate_{0, 0, 0};
};

/// Share of a row that labels take in the panel of the motion.
inline constexpr float motion_label_share = 0.385f;

/// In how many steps bodies go to their places; of either dimension.
void draw_motion_steps(const PanelContext& context);

/// Limits of quality, of either dimension: they hold for every motion and deformation from here on,
/// dragged or typed.
void draw_quality_limits(const PanelContext& context);

/// Rows for the region outside which nothing moves (SmoothOptions::keep_outside): none, a circle
/// about the selection (of a volume mesh a sphere), a box around it.
void draw_keep_outside(const PanelContext& context);

}  // namespace winslow::gui
