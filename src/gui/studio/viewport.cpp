#include "gui/studio/viewport.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double drag_threshold = 4;
constexpr double pick_radius = 7;
constexpr double handle_radius = 9;
// Small, so that a body is taken by its middle without catching the pivot.
constexpr double pivot_radius = 6;
constexpr double ring_gap = 26;
constexpr double smallest_ring = 44;
constexpr double zoom_per_notch = 1.2;
// With Shift held a rotation goes in steps, a translation along one axis.
constexpr double rotation_step = 5;

double angle_about(const Vec2& pivot, const Vec2& point) {
  return std::atan2(point.y() - pivot.y(), point.x() - pivot.x());
}

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

Handle handle_at(const Handles& handles, const Vec2& p, double scale) {
  const double r = handle_radius * scale;
  if ((p - handles.knob()).norm() <= r) return Handle::ring;
  if ((p - handles.pivot).norm() <= pivot_radius * scale) return Handle::pivot;
  const double off_ring = std::abs((p - handles.pivot).norm() - handles.radius);
  return off_ring <= 0.7 * r ? Handle::ring : Handle::none;
}

}  // namespace

Vec2 Handles::knob() const { return pivot + radius * Vec2(std::cos(angle), -std::sin(angle)); }

std::optional<Handles> Viewport::handles(const ViewportScene& scene, const Camera& camera) {
  if (!scene.boundary || scene.selection.empty()) return std::nullopt;
  const double reach = scene.reach / camera.units_per_pixel();
  const double room = 0.42 * std::min(camera.viewport_width(), camera.viewport_height());
  Handles h;
  h.pivot = camera.to_screen(scene.pivot);
  // Seen from afar the ring stays large enough to take, seen from near within the window.
  h.radius = std::max(smallest_ring * scene.scale, std::min(reach + ring_gap * scene.scale, room));
  h.angle = pi / 4 + radians(scene.turned);
  return h;
}

void Viewport::update(const PointerState& p, const ViewportScene& scene, Camera& camera,
                      ActionQueue& actions) {
  if (p.over && p.wheel != 0 && !scene.wheel_is_lens)
    camera.zoom_at(p.position, std::pow(zoom_per_notch, p.wheel));
  const bool pan_pressed = (p.middle && !last_.middle) || (p.right && !last_.right);
  const bool left_pressed = p.left && !last_.left;

  if (p.cancel && gesture_ != Gesture::none) {
    end(actions, true);
  } else if (gesture_ == Gesture::none) {
    hover(p, scene, camera, actions);
    if (p.over && start_box(p, scene)) {
      press_ = p.position;
      gesture_ = Gesture::box;
    } else if (p.over && pan_pressed) {
      gesture_ = Gesture::pan;
      pan_button_ = true;
    } else if (p.over && left_pressed) {
      press(p, scene, camera, actions);
    }
  } else if (pan_button_ ? !(p.middle || p.right) : !p.left) {
    follow(p, scene, camera, actions);
    release(p, camera, actions);
  } else {
    follow(p, scene, camera, actions);
  }
  last_ = p;
}

/// With the left button when asked for, or with Control and the right one at any time.
bool Viewport::start_box(const PointerState& p, const ViewportScene& scene) {
  if (!scene.boundary) return false;
  if (p.control && p.right && !last_.right) return pan_button_ = true;
  return scene.box_zoom && p.left && !last_.left;
}

std::optional<Bounds> Viewport::box() const {
  if (gesture_ != Gesture::box) return std::nullopt;
  return Bounds{press_.cwiseMin(last_.position), press_.cwiseMax(last_.position)};
}

void Viewport::hover(const PointerState& p, const ViewportScene& scene, const Camera& camera,
                     ActionQueue& actions) {
  hit_.reset();
  hovered_handle_ = Handle::none;
  if (p.over && scene.boundary) {
    if (const auto h = handles(scene, camera))
      hovered_handle_ = handle_at(*h, p.position, scene.scale);
    if (hovered_handle_ == Handle::none)
      hit_ = scene.boundary->pick(camera.to_world(p.position),
                                  pick_radius * scene.scale * camera.units_per_pixel());
  }
  std::vector<Index> now = hit_ ? hit_->markers : std::vector<Index>{};
  if (now == last_hover_) return;
  last_hover_ = now;
  actions.emplace_back(action::HoverMarkers{std::move(now)});
}

void Viewport::press(const PointerState& p, const ViewportScene& scene, const Camera& camera,
                     ActionQueue& actions) {
  press_ = p.position;
  press_world_ = camera.to_world(p.position);
  motion_ = RigidMotion{0, scene.pivot, Vec2(0, 0)};
  if (hovered_handle_ == Handle::pivot) {
    gesture_ = Gesture::pivot;
  } else if (hovered_handle_ == Handle::ring) {
    gesture_ = Gesture::rotate;
    turned_ = 0;
    last_angle_ = angle_about(scene.pivot, press_world_);
    actions.emplace_back(action::BeginDrag{});
  } else {
    gesture_ = hit_ ? Gesture::press_body : Gesture::press_empty;
  }
}

void Viewport::begin_move(const ViewportScene& scene, ActionQueue& actions) {
  const bool selected = std::includes(scene.selection.begin(), scene.selection.end(),
                                      hit_->markers.begin(), hit_->markers.end());
  // The rim around the mesh moves only if it was selected first: a drag that starts on it by
  // accident pans.
  if (!selected && !hit_->hole) {
    gesture_ = Gesture::pan;
    pan_button_ = false;
    return;
  }
  if (!selected) actions.emplace_back(action::SelectMarkers{hit_->markers, false});
  actions.emplace_back(action::BeginDrag{});
  gesture_ = Gesture::move;
}

void Viewport::follow(const PointerState& p, const ViewportScene& scene, Camera& camera,
                      ActionQueue& actions) {
  const bool pressed = gesture_ == Gesture::press_body || gesture_ == Gesture::press_empty;
  if (pressed && (p.position - press_).norm() > drag_threshold * scene.scale) {
    if (gesture_ == Gesture::press_body) {
      begin_move(scene, actions);
    } else {
      gesture_ = Gesture::pan;
      pan_button_ = false;
    }
    if (gesture_ == Gesture::pan) last_.position = press_;
  }
  if (p.position == last_.position && gesture_ != Gesture::move) return;
  switch (gesture_) {
    case Gesture::pan:
      camera.pan(p.position - last_.position);
      break;
    case Gesture::pivot:
      actions.emplace_back(action::SetPivot{camera.to_world(p.position)});
      break;
    case Gesture::rotate:
      rotate_to(p, camera, actions);
      break;
    case Gesture::move: {
      Vec2 by = camera.to_world(p.position) - press_world_;
      if (p.shift) by[std::abs(by.x()) >= std::abs(by.y()) ? 1 : 0] = 0;
      if (by == motion_.translate) break;
      motion_.translate = by;
      actions.emplace_back(action::DragTo{motion_});
      break;
    }
    case Gesture::none:
    case Gesture::box:
    case Gesture::press_body:
    case Gesture::press_empty:
      break;
  }
}

void Viewport::rotate_to(const PointerState& p, const Camera& camera, ActionQueue& actions) {
  const double angle = angle_about(motion_.pivot, camera.to_world(p.position));
  turned_ += wrapped(angle - last_angle_) * (180 / pi);
  last_angle_ = angle;
  motion_.rotate = p.shift ? rotation_step * std::round(turned_ / rotation_step) : turned_;
  actions.emplace_back(action::DragTo{motion_});
}

void Viewport::release(const PointerState& p, const Camera& camera, ActionQueue& actions) {
  const bool add = p.shift || p.control;
  if (p.click_taken && gesture_ != Gesture::box) return end(actions, false);
  if (gesture_ == Gesture::box) {
    last_.position = p.position;
    const Bounds pixels = *box();
    // A click is no box.
    if (pixels.size().minCoeff() > drag_threshold) {
      const Vec2 a = camera.to_world(pixels.min);
      const Vec2 b = camera.to_world(pixels.max);
      actions.emplace_back(action::ZoomTo{{a.cwiseMin(b), a.cwiseMax(b)}});
    }
  } else if (gesture_ == Gesture::press_body)
    actions.emplace_back(action::SelectMarkers{hit_->markers, add});
  else if (gesture_ == Gesture::press_empty && !add)
    actions.emplace_back(action::SelectMarkers{{}, false});
  end(actions, false);
}

void Viewport::end(ActionQueue& actions, bool cancelled) {
  if (dragging()) {
    if (cancelled)
      actions.emplace_back(action::CancelDrag{});
    else
      actions.emplace_back(action::EndDrag{});
  }
  gesture_ = Gesture::none;
  pan_button_ = false;
}

}  // namespace winslow::gui
