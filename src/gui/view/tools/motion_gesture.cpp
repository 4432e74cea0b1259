#include "gui/view/tools/motion_gesture.h"

#include <cmath>

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

namespace {

constexpr double fine_share = 0.1;
constexpr double rotation_step = 5;  // degrees
constexpr double smallest_step = 8;  // pixels

double angle_about(const Vec2& pivot, const Vec2& point) {
  return std::atan2(point.y() - pivot.y(), point.x() - pivot.x());
}

}  // namespace

void MotionGesture::begin(Kind kind, const ScreenPoint& from, const Vec2& pivot,
                          std::optional<int> axis) {
  kind_ = kind;
  axis_ = axis;
  modifiers_ = {};
  motion_ = RigidMotion{0, pivot, Vec2(0, 0)};
  last_ = from;
  moved_ = Vec2(0, 0);
  turned_ = 0;
}

bool MotionGesture::follow(const ScreenPoint& mouse, Modifiers modifiers, const View& view) {
  const double speed = modifiers.fine ? fine_share : 1;
  const Vec2 from = view.to_plane(last_);
  const Vec2 to = view.to_plane(mouse);
  last_ = mouse;
  modifiers_ = modifiers;
  RigidMotion next = motion_;
  if (kind_ == Kind::move) {
    moved_ += speed * (to - from);
    next.translate = moved_;
    if (modifiers.snap) {
      const double step = grid_step(view, *motion_.pivot);
      next.translate = Vec2(step * (moved_ / step).array().round().matrix());
    }
    if (axis_) next.translate[1 - *axis_] = 0;
  } else {
    const Vec2 pivot = motion_.pivot->head<2>();
    const double by = angle_about(pivot, to) - angle_about(pivot, from);
    turned_ += speed * std::remainder(by, 2 * pi) * (180 / pi);
    next.rotate = modifiers.snap ? rotation_step * std::round(turned_ / rotation_step) : turned_;
  }
  if (same_motion(next, motion_)) return false;
  motion_ = next;
  return true;
}

bool MotionGesture::type(const TypedMotion& typed) {
  const auto first = typed.value(0);
  const auto second = typed.value(1);
  if (!first || !second) return false;
  RigidMotion next = motion_;
  if (kind_ == Kind::rotate) {
    next.rotate = *first;
  } else if (axis_) {
    next.translate = Vec2(0, 0);
    next.translate[*axis_] = *first;
  } else {
    next.translate = Vec2(*first, *second);
  }
  if (same_motion(next, motion_)) return false;
  motion_ = next;
  return true;
}

void MotionGesture::toggle_axis(int axis) {
  if (axis_ == axis)
    axis_.reset();
  else
    axis_ = axis;
}

double MotionGesture::grid_step(const View& view, const Vec3& at) {
  const double least = smallest_step * view.pixel_size(at);
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= least) return digit * decade;
  return 10 * decade;
}

}  // namespace winslow::gui
