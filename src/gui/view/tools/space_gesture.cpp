#include "gui/view/tools/space_gesture.h"

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "gui/view/tools/space_travel.h"

namespace winslow::gui {

namespace {

constexpr double fine_speed = 0.1;
constexpr double turn_step = 5;  // degrees
constexpr std::array<const char*, 3> mesh_axes{"x", "y", "z"};

double rounded_to(double step, double value) { return step * std::round(value / step); }

}  // namespace

void SpaceGesture::begin(const SpaceHandle& handle, const ScreenPoint& from,
                         const SpaceGizmo& gizmo, const View& view) {
  *this = SpaceGesture();
  handle_ = handle;
  frame_ = gizmo.frame;
  radius_ = handle.kind == SpaceHandle::Kind::screen_ring ? gizmo.screen_radius : gizmo.ring_radius;
  viewer_ = gizmo.viewer;
  motion_.pivot = gizmo.pivot;
  press_ = last_ = slowed_ = from;
  if (!turns()) return;
  motion_.axis = axis();
  find_grip(view);
}

Vec3 SpaceGesture::axis() const {
  if (locked_) return Vec3::Unit(*locked_);
  return handle_.kind == SpaceHandle::Kind::ring ? frame_.axes[at(handle_.axis)] : viewer_;
}

/// Where the swept angle begins in the picture.
void SpaceGesture::find_grip(const View& view) {
  const Vec3 about = axis();
  const auto [origin, direction] = view.unproject(press_);
  const double slope = about.dot(direction.normalized());
  Vec3 arm = viewer_;  // the near side of a ring that is seen edge on
  if (std::abs(slope) > 0.25)
    arm = origin + about.dot(motion_.pivot - origin) / about.dot(direction) * direction -
          motion_.pivot;
  arm -= about.dot(arm) * about;
  grip_ = arm.norm() > 0 ? Vec3(arm.normalized()) : Vec3(frame_.axes[0]);
}

bool SpaceGesture::follow(const ScreenPoint& mouse, Modifiers modifiers, const View& view) {
  const ScreenPoint before = slowed_;
  slowed_ = slowed_ + (modifiers.fine ? fine_speed : 1.0) * (mouse - last_);
  last_ = mouse;
  modifiers_ = modifiers;
  SpaceMotion next = motion_;
  if (turns()) {
    turned_ += turn_about(view, motion_.pivot, axis(), radius_, before, slowed_);
    next.axis = axis();
    next.rotate = modifiers.snap ? rounded_to(turn_step, turned_) : turned_;
  } else {
    next = moved_to(view);
  }
  if (same_motion(next, motion_)) return false;
  motion_ = next;
  return true;
}

/// From where the mouse was pressed at once, so that no path adds up.
SpaceMotion SpaceGesture::moved_to(const View& view) const {
  SpaceMotion next = motion_;
  const auto along = directions();
  const Vec3& from = motion_.pivot;
  if (along.size() == 1)
    next.translate = travel_along(view, from, along[0].along, press_, slowed_) * along[0].along;
  else
    next.translate = travel_in_plane(
        view, from, along.size() == 2 ? frame_.axes[at(handle_.axis)] : viewer_, press_, slowed_);
  if (!modifiers_.snap) return next;
  const double step = snap_step(view);
  const Vec3 free = next.translate;
  next.translate.setZero();
  for (const Direction& d : along) next.translate += rounded_to(step, free.dot(d.along)) * d.along;
  return next;
}

bool SpaceGesture::type(const TypedMotion& typed) {
  SpaceMotion next = motion_;
  next.translate.setZero();
  if (turns()) {
    const auto degrees = typed.value(0);
    if (!degrees) return false;
    next.axis = axis();
    next.rotate = *degrees;
  } else {
    const auto along = directions();
    for (std::size_t k = 0; k < along.size(); ++k) {
      const auto way = typed.value(k);
      if (!way) return false;
      next.translate += *way * along[k].along;
    }
  }
  if (same_motion(next, motion_)) return false;
  motion_ = next;
  return true;
}

void SpaceGesture::toggle_axis(int axis, const View& view) {
  if (locked_ == axis)
    locked_.reset();
  else
    locked_ = axis;
  if (turns()) find_grip(view);
}

std::vector<SpaceGesture::Direction> SpaceGesture::directions() const {
  if (locked_) return {{Vec3::Unit(*locked_), mesh_axes[at(*locked_)]}};
  const auto direction = [&](int k) { return Direction{frame_.axes[at(k)], frame_.name(k)}; };
  if (handle_.kind == SpaceHandle::Kind::arrow) return {direction(handle_.axis)};
  if (handle_.kind == SpaceHandle::Kind::square)
    return {direction((handle_.axis + 1) % 3), direction((handle_.axis + 2) % 3)};
  std::vector<Direction> all;
  for (int k = 0; k < 3; ++k) all.push_back({Vec3::Unit(k), mesh_axes[at(k)]});
  return all;
}

const char* SpaceGesture::axis_name() const {
  if (locked_) return mesh_axes[at(*locked_)];
  if (handle_.kind == SpaceHandle::Kind::screen_ring) return "the line of sight";
  return frame_.aligned && handle_.axis == 2 ? "the axis" : frame_.name(handle_.axis);
}

}  // namespace winslow::gui
