#include "gui/view/tools/viewport.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double drag_threshold = 4;
constexpr double pick_radius = 7;
constexpr double node_radius = 10;
constexpr double snap_radius = 14;
constexpr double zoom_per_notch = 1.2;

/// A tolerance around a point, in units of the mesh.
double world(double pixels, const ViewportScene& scene, const View& view, const Vec2& at) {
  return pixels * scene.scale * view.pixel_size(at);
}

/// A body counts as one: it is not taken by half.
bool free_to_take(const std::vector<Index>& markers, const ViewportScene& scene) {
  return std::ranges::none_of(
      markers, [&](Index m) { return std::ranges::binary_search(scene.taken_out, m); });
}

}  // namespace

std::optional<Gizmo> Viewport::gizmo(const ViewportScene& scene, const View& view) {
  if (!scene.boundary || scene.selection.empty() || scene.shape.active || scene.look_only)
    return std::nullopt;
  return make_gizmo(view, scene.pivot, scene.reach, scene.turned, scene.scale);
}

void Viewport::update(const PointerState& p, const ViewportScene& scene, View& view,
                      ActionQueue& actions) {
  if (p.over && p.wheel != 0 && !scene.wheel_is_lens) wheel(p, scene, view, actions);
  const bool pan_pressed = (p.middle && !last_.middle) || (p.right && !last_.right);
  const bool left_pressed = p.left && !last_.left;

  // Before Enter counts, which may have come in the same frame.
  if (dragging()) take_typed(p, view, actions);
  if (p.cancel && gesture_ != Gesture::none) {
    end(actions, true);
  } else if (p.accept && !last_.accept && dragging()) {
    end(actions, false);
  } else if (gesture_ == Gesture::none) {
    hover(p, scene, view, actions);
    if (p.over && start_box(p, scene)) {
      press_ = p.position;
      gesture_ = Gesture::box;
    } else if (p.over && pan_pressed) {
      gesture_ = Gesture::pan;
      pan_button_ = true;
    } else if (p.over && left_pressed) {
      press(p, scene, actions);
    }
  } else if (pan_button_ ? !(p.middle || p.right) : !p.left) {
    follow(p, scene, view, actions);
    release(p, scene, view, actions);
  } else {
    follow(p, scene, view, actions);
  }
  last_ = p;
}

/// With the left button when asked for, or with Control and the right one at any time.
bool Viewport::start_box(const PointerState& p, const ViewportScene& scene) {
  if (!scene.boundary) return false;
  if (p.control && p.right && !last_.right) return pan_button_ = true;
  return scene.box_zoom && p.left && !last_.left;
}

std::optional<ScreenBox> Viewport::box() const {
  if (gesture_ != Gesture::box) return std::nullopt;
  const ScreenPoint& a = press_;
  const ScreenPoint& b = last_.position;
  return ScreenBox{{std::min(a.x(), b.x()), std::min(a.y(), b.y())},
                   {std::max(a.x(), b.x()), std::max(a.y(), b.y())}};
}

void Viewport::wheel(const PointerState& p, const ViewportScene& scene, View& view,
                     ActionQueue& actions) {
  const double factor = std::pow(zoom_per_notch, p.wheel);
  if (gesture_ != Gesture::shape) return view.zoom_at(p.position, factor);
  // From nothing it grows to something that can be seen.
  const double least = 10 * view.pixel_size(view.to_plane(p.position));
  const double radius = std::max(scene.shape.radius * factor, p.wheel > 0 ? least : 0.0);
  actions.emplace_back(action::SetShapeEdit{true, radius < 0.5 * least ? 0 : radius});
}

void Viewport::hover(const PointerState& p, const ViewportScene& scene, const View& view,
                     ActionQueue& actions) {
  hit_.reset();
  node_.reset();
  hovered_handle_ = Handle::none;
  if (p.over && scene.boundary && !scene.look_only) {
    const Vec2 at = view.to_plane(p.position);
    if (const auto g = gizmo(scene, view)) hovered_handle_ = g->at(p.position);
    if (scene.shape.active)
      node_ = scene.boundary->pick_node(at, world(node_radius, scene, view, at));
    if (node_ &&
        !free_to_take(scene.boundary->bodies()[static_cast<std::size_t>(node_->body)].markers,
                      scene))
      node_.reset();
    if (hovered_handle_ == Handle::none && !node_)
      hit_ = scene.boundary->pick(at, world(pick_radius, scene, view, at));
    if (hit_ && !free_to_take(hit_->markers, scene)) hit_.reset();
  }
  std::vector<Index> now = hit_ ? hit_->markers : std::vector<Index>{};
  if (now == last_hover_) return;
  last_hover_ = now;
  actions.emplace_back(action::HoverMarkers{std::move(now)});
}

void Viewport::press(const PointerState& p, const ViewportScene& scene, ActionQueue& actions) {
  press_ = p.position;
  if (hovered_handle_ != Handle::none)
    press_handle(p, scene, actions);
  else if (node_)
    gesture_ = Gesture::press_node;
  else
    gesture_ = hit_ ? Gesture::press_body : Gesture::press_empty;
}

void Viewport::press_handle(const PointerState& p, const ViewportScene& scene,
                            ActionQueue& actions) {
  switch (hovered_handle_) {
    case Handle::ring:
      return begin(Gesture::rotate, scene, actions);
    case Handle::arrow_x:
      return begin(Gesture::move, scene, actions, 0);
    case Handle::arrow_y:
      return begin(Gesture::move, scene, actions, 1);
    case Handle::centre:
      if (!p.alt) return begin(Gesture::move, scene, actions);
      [[fallthrough]];
    case Handle::pivot:
      gesture_ = Gesture::pivot;
      pivot_before_ = scene.pivot;
      return;
    case Handle::none:
      return;
  }
}

void Viewport::begin(Gesture gesture, const ViewportScene& scene, ActionQueue& actions,
                     std::optional<int> axis) {
  gesture_ = gesture;
  typed_.clear();
  drag_.begin(gesture == Gesture::rotate ? MotionGesture::Kind::rotate : MotionGesture::Kind::move,
              press_, scene.pivot, axis);
  actions.emplace_back(action::BeginDrag{gesture == Gesture::shape});
}

/// The mouse has gone far enough from where it was pressed: this is no click.
void Viewport::leave_press(const ViewportScene& scene, ActionQueue& actions) {
  last_.position = press_;
  if (gesture_ == Gesture::press_node) {
    const auto& arc = scene.shape.arc;
    if (!arc || arc->body != node_->body || !arc->contains(node_->position))
      select_node(false, scene, actions);
    return begin(Gesture::shape, scene, actions);
  }
  // Shapes are edited by their nodes; the rim around the mesh moves only if it was selected first:
  // a drag that starts on it by accident pans.
  const bool selected = hit_ && std::includes(scene.selection.begin(), scene.selection.end(),
                                              hit_->markers.begin(), hit_->markers.end());
  if (gesture_ == Gesture::press_empty || scene.shape.active || (!selected && !hit_->hole)) {
    gesture_ = Gesture::pan;
    pan_button_ = false;
    return;
  }
  if (!selected) actions.emplace_back(action::SelectMarkers{hit_->markers, false});
  begin(Gesture::move, scene, actions);
}

void Viewport::follow(const PointerState& p, const ViewportScene& scene, View& view,
                      ActionQueue& actions) {
  const bool pressed = gesture_ == Gesture::press_body || gesture_ == Gesture::press_empty ||
                       gesture_ == Gesture::press_node;
  if (pressed && (p.position - press_).norm() > drag_threshold * scene.scale)
    leave_press(scene, actions);
  if (gesture_ == Gesture::pan)
    view.pan(p.position - last_.position);
  else if (gesture_ == Gesture::pivot)
    follow_pivot(p, scene, view, actions);
  else if (dragging())
    follow_drag(p, view, actions);
}

void Viewport::follow_drag(const PointerState& p, const View& view, ActionQueue& actions) {
  if (gesture_ != Gesture::rotate) {
    if (p.key_x && !last_.key_x) drag_.toggle_axis(0);
    if (p.key_y && !last_.key_y) drag_.toggle_axis(1);
  }
  if (typed_.active()) {
    // An axis may have been chosen since.
    if (drag_.type(typed_)) actions.emplace_back(action::DragTo{drag_.motion()});
    return;
  }
  if (drag_.follow(p.position, {p.shift, p.control}, view))
    actions.emplace_back(action::DragTo{drag_.motion()});
}

void Viewport::take_typed(const PointerState& p, const View& view, ActionQueue& actions) {
  const bool was_active = typed_.active();
  bool changed = typed_.type(p.text);
  if (p.erase && !last_.erase) changed |= typed_.erase();
  if (p.next && !last_.next) typed_.next(drag_.typed_fields());
  if (!changed) return;
  // Without numbers the mouse counts again, from where it is.
  const bool other = typed_.active()
                         ? drag_.type(typed_)
                         : was_active && drag_.follow(p.position, {p.shift, p.control}, view);
  if (other) actions.emplace_back(action::DragTo{drag_.motion()});
}

void Viewport::follow_pivot(const PointerState& p, const ViewportScene& scene, const View& view,
                            ActionQueue& actions) {
  if (p.position == last_.position && p.control == last_.control) return;
  snapped_to_.clear();
  Vec2 at = view.to_plane(p.position);
  if (p.control) {
    const Vec2 mouse = at;
    double best = world(snap_radius, scene, view, mouse);
    const auto try_point = [&](const Vec2& point, const std::string& name) {
      if ((point - mouse).norm() >= best) return;
      best = (point - mouse).norm();
      at = point;
      snapped_to_ = name;
    };
    // Points with a name pull harder: a leading edge has nodes close by, and is one.
    for (const auto& [point, name] : scene.snaps) try_point(point, name);
    if (const auto hit = scene.boundary->pick_node(mouse, 0.5 * best))
      try_point(scene.boundary->position(hit->node), "node " + std::to_string(hit->node));
  }
  actions.emplace_back(action::SetPivot{at, {}});
}

void Viewport::select_node(bool extend, const ViewportScene& scene, ActionQueue& actions) {
  BoundaryArc arc{node_->body, node_->position, node_->position};
  if (extend && scene.shape.arc && scene.shape.arc->body == node_->body)
    arc = extended(*scene.shape.arc, node_->position,
                   scene.boundary->bodies()[static_cast<std::size_t>(node_->body)].nodes.size());
  actions.emplace_back(action::SelectArc{arc});
}

void Viewport::release(const PointerState& p, const ViewportScene& scene, const View& view,
                       ActionQueue& actions) {
  const bool add = p.shift || p.control;
  if (gesture_ == Gesture::press_empty && p.picks_nodes && !p.click_taken)
    actions.emplace_back(action::Remark{"No node is there. Click nearer to one, or zoom in."});
  if (p.click_taken && gesture_ != Gesture::box) return end(actions, false);
  if (gesture_ == Gesture::box) {
    last_.position = p.position;
    const ScreenBox pixels = *box();
    const ScreenVector size = pixels.size();
    // A click is no box.
    if (std::min(size.x(), size.y()) > drag_threshold) {
      const Vec2 a = view.to_plane(pixels.min);
      const Vec2 b = view.to_plane(pixels.max);
      actions.emplace_back(action::ZoomTo{{a.cwiseMin(b), a.cwiseMax(b)}});
    }
  } else if (gesture_ == Gesture::press_body)
    actions.emplace_back(action::SelectMarkers{hit_->markers, add});
  else if (gesture_ == Gesture::press_node)
    select_node(add, scene, actions);
  else if (gesture_ == Gesture::press_empty && scene.shape.active && !add)
    click_beside_nodes(scene, actions);
  else if (gesture_ == Gesture::press_empty && !add)
    actions.emplace_back(action::SelectMarkers{{}, false});
  end(actions, false);
}

/// Lets go of an arc; without one the click was meant for a node.
void Viewport::click_beside_nodes(const ViewportScene& scene, ActionQueue& actions) {
  if (scene.shape.arc)
    actions.emplace_back(action::SelectArc{});
  else
    actions.emplace_back(
        action::Remark{"No boundary node is there. Take one of the dots; zoom in where they are "
                       "close together. Esc ends the editing of nodes."});
}

void Viewport::end(ActionQueue& actions, bool cancelled) {
  if (gesture_ == Gesture::pivot && cancelled)
    actions.emplace_back(action::SetPivot{pivot_before_, {}});
  if (dragging()) {
    if (cancelled)
      actions.emplace_back(action::CancelDrag{});
    else
      actions.emplace_back(action::EndDrag{});
  }
  gesture_ = Gesture::none;
  pan_button_ = false;
  snapped_to_.clear();
}

}  // namespace winslow::gui
