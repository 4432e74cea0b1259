#include "gui/panels/forms/motion_steps_row.h"

#include <array>

#include "gui/panels/forms/quality_limits_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

void draw_motion_steps(const PanelContext& context) {
  constexpr std::array<int, 4> increments{0, 1, 8, 32};
  const std::vector<std::string> names{"Automatic", "At once", "8 steps", "32 steps"};
  const MotionOptions& now = context.session.jobs().motion_options();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < increments.size(); ++i)
    if (increments[i] == now.increments) chosen = i;
  constexpr const char* tip =
      "In how many steps the body goes to its place, the mesh smoothed after each. Automatic: at "
      "once, and in steps only if that leaves the mesh tangled.";
  ui::row("Steps", tip, motion_label_share);
  if (ui::combo("motion/steps", names, chosen, tip)) {
    MotionOptions options = now;
    options.increments = increments[chosen];
    context.emit(action::EditMotionOptions{difference(now, options)});
  }
}

void draw_quality_limits(const PanelContext& context) {
  const Jobs& jobs = context.session.jobs();
  MotionOptions options = jobs.motion_options();
  if (ui::quality_limits_form("motion", options.floor, context.session.in_space() ? 3 : 2,
                              follows_path(options, jobs.smooth_options())))
    context.emit(action::EditMotionOptions{difference(jobs.motion_options(), options)});
}

}  // namespace winslow::gui
