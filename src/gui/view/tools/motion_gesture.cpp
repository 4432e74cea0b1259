#include "gui/view/tools/motion_gesture.h"

#include <charconv>

namespace winslow::gui {

bool TypedMotion::type(std::u32string_view text) {
  constexpr std::size_t longest = 24;
  bool taken = false;
  for (const char32_t c : text) {
    const bool digit = c >= U'0' && c <= U'9';
    if (!digit && c != U'.' && c != U',' && c != U'-' && c != U'+') continue;
    if (fields_[at_].size() == longest) continue;
    fields_[at_] += c == U',' ? '.' : static_cast<char>(c);
    taken = true;
  }
  return taken;
}

bool TypedMotion::erase() {
  if (fields_[at_].empty()) {
    if (at_ == 0) return false;
    --at_;
    return true;
  }
  fields_[at_].pop_back();
  return true;
}

void TypedMotion::next(std::size_t count) { at_ = count < 2 ? 0 : (at_ + 1) % count; }

std::optional<double> TypedMotion::value(std::size_t field) const {
  std::string_view text = fields_[field];
  if (text.empty()) return 0.0;
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

namespace {

using Kind = Handle::Kind;

constexpr double fine_speed = 0.1;
constexpr double turn_step = 5;      // degrees
constexpr double smallest_step = 8;  // pixels
// Pixels: a mouse that is as near to where it was pressed is there, but for the round-off of its
// way, and nothing moves.
constexpr double at_press = 1e-4;
constexpr std::array<const char*, 3> mesh_axes{"x", "y", "z"};

double rounded_to(double step, double value) { return step * std::round(value / step); }

}  // namespace

void MotionGesture::begin(const Handle& handle, const ScreenPoint& from, const Gizmo& gizmo,
                          const View& view) {
  *this = MotionGesture();
  handle_ = handle;
  frame_ = gizmo.frame();
  in_plane_ = gizmo.place.in_plane;
  radius_ = handle.kind == Kind::screen_ring ? gizmo.screen_radius : gizmo.ring_radius;
  viewer_ = gizmo.viewer;
  pivot_ = gizmo.place.pivot;
  last_ = from;
  from_ = to_ = view.at_depth_of(pivot_, from);
  if (handle.kind == Kind::arrow && !frame_.aligned) locked_ = handle.axis;
  if (!turns()) return;
  now_.axis = axis();
  find_grip(view, from);
}

Vec3 MotionGesture::axis() const {
  if (locked_) return Vec3::Unit(*locked_);
  return handle_.kind == Kind::ring ? frame_.axes[at(handle_.axis)] : viewer_;
}

/// Finds where the swept angle begins in the picture.
void MotionGesture::find_grip(const View& view, const ScreenPoint& press) {
  const Vec3 about = axis();
  const auto [origin, direction] = view.unproject(press);
  const double slope = about.dot(direction.normalized());
  Vec3 arm = viewer_;  // the near side of a ring that is seen edge on
  if (std::abs(slope) > 0.25)
    arm = origin + about.dot(pivot_ - origin) / about.dot(direction) * direction - pivot_;
  arm -= about.dot(arm) * about;
  grip_ = arm.norm() > 0 ? Vec3(arm.normalized()) : Vec3(frame_.axes[0]);
}

bool MotionGesture::set_way(const Way& next) {
  if (next == now_) return false;
  now_ = next;
  return true;
}

bool MotionGesture::drag_to(const ScreenPoint& mouse, Modifiers modifiers, const View& view) {
  const double speed = modifiers.fine ? fine_speed : 1;
  const ScreenPoint before = last_;
  last_ = mouse;
  modifiers_ = modifiers;
  to_ += speed * (view.at_depth_of(pivot_, mouse) - view.at_depth_of(pivot_, before));
  Way next = now_;
  if (turns()) {
    turned_ += speed * turn_about(view, pivot_, axis(), radius_, before, mouse);
    next.axis = axis();
    const double turned = radians(std::abs(turned_)) * radius_ < at_press ? 0 : turned_;
    next.rotate = modifiers.snap ? rounded_to(turn_step, turned) : turned;
  } else {
    next.translate = moved_to(view);
  }
  return set_way(next);
}

/// The move from the point of the press directly, so that the path of the mouse does not matter.
Vec3 MotionGesture::moved_to(const View& view) const {
  const auto along = directions();
  const ScreenPoint press = view.project(from_).at, mouse = view.project(to_).at;
  Vec3 way(0, 0, 0);
  if ((mouse - press).norm() < at_press) return way;
  if (along.size() == 1)
    way += travel_along(view, pivot_, along[0].along, press, mouse) * along[0].along;
  else
    way = travel_in_plane(view, pivot_,
                          handle_.kind == Kind::square ? frame_.axes[at(handle_.axis)] : viewer_,
                          press, mouse);
  if (!modifiers_.snap) return way;
  const double step = snap_step(view);
  Vec3 snapped(0, 0, 0);
  for (const Direction& d : along) snapped += rounded_to(step, way.dot(d.along)) * d.along;
  return snapped;
}

bool MotionGesture::type(const TypedMotion& typed) {
  Way next = now_;
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
  return set_way(next);
}

void MotionGesture::toggle_axis(int axis, const View& view) {
  if (in_plane_ && (turns() || axis == 2)) return;
  if (locked_ == axis)
    locked_.reset();
  else
    locked_ = axis;
  if (turns()) find_grip(view, view.project(from_).at);
}

Handle MotionGesture::shown_handle() const {
  if (locked_ && !frame_.aligned) return {turns() ? Kind::ring : Kind::arrow, *locked_};
  const bool freed = handle_.kind == Kind::arrow && !frame_.aligned;
  return freed ? Handle{Kind::centre, 0} : handle_;
}

std::vector<MotionGesture::Direction> MotionGesture::directions() const {
  if (locked_) return {{Vec3::Unit(*locked_), mesh_axes[at(*locked_)]}};
  const auto direction = [&](int k) { return Direction{frame_.axes[at(k)], frame_.name(k)}; };
  if (handle_.kind == Kind::arrow && frame_.aligned) return {direction(handle_.axis)};
  if (handle_.kind == Kind::square)
    return {direction((handle_.axis + 1) % 3), direction((handle_.axis + 2) % 3)};
  std::vector<Direction> all;
  for (int k = 0; k < (in_plane_ ? 2 : 3); ++k) all.push_back({Vec3::Unit(k), mesh_axes[at(k)]});
  return all;
}

const char* MotionGesture::axis_name() const {
  if (in_plane_) return "";
  if (locked_) return mesh_axes[at(*locked_)];
  if (handle_.kind == Kind::screen_ring) return "the line of sight";
  return frame_.aligned && handle_.axis == 2 ? "the axis" : frame_.name(handle_.axis);
}

double MotionGesture::grid_step(const View& view, const Vec3& at) {
  const double least = smallest_step * view.pixel_size(at);
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= least) return digit * decade;
  return 10 * decade;
}

}  // namespace winslow::gui
