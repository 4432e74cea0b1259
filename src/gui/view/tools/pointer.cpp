#include "gui/view/tools/pointer.h"

namespace winslow::gui {

std::optional<ScreenPoint> ContextClick::update(const PointerState& pointer, double scale) {
  const bool pressed = pointer.right && !was_down_;
  const bool released = !pointer.right && was_down_;
  was_down_ = pointer.right;
  // With Control the right button draws the box to zoom to.
  if (pressed && pointer.over && !pointer.control && !pointer.left) press_ = pointer.position;
  if (press_ && (pointer.position - *press_).norm() > drag_threshold * scale) press_.reset();
  if (pointer.left) press_.reset();
  if (!released) return std::nullopt;
  return std::exchange(press_, std::nullopt);
}

double distance_to_segment(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
  const ScreenVector along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(along.squared_norm(), 1e-30), 0.0, 1.0);
  return (p - a - t * along).norm();
}

}  // namespace winslow::gui
