#include "gui/view/tools/viewport.h"

namespace winslow::gui {

namespace {

constexpr double zoom_per_notch = 1.2;

/// The wheel sets how far a drag of the boundary fades.
void turn_radius(const PointerFrame& frame, const Vec3& at) {
  const double factor = std::pow(zoom_per_notch, frame.pointer.wheel);
  // From 0, the radius grows to one that is visible.
  const double least = 10 * frame.view.pixel_size(at);
  const double now = frame.scene.session.selection().shape_edit().radius;
  const double radius = std::max(now * factor, frame.pointer.wheel > 0 ? least : 0.0);
  frame.actions.emplace_back(action::SetShapeEdit{true, radius < 0.5 * least ? 0 : radius});
}

}  // namespace

std::optional<ScreenPoint> ContextClick::update(const PointerState& pointer, double scale) {
  const bool pressed = pointer.right && !was_down_;
  const bool released = !pointer.right && was_down_;
  was_down_ = pointer.right;
  // Control with the right button draws the box to zoom to.
  if (pressed && pointer.over && !pointer.control && !pointer.left) press_ = pointer.position;
  if (press_ && (pointer.position - *press_).norm() > drag_threshold * scale) press_.reset();
  if (pointer.left) press_.reset();
  if (!released) return std::nullopt;
  return std::exchange(press_, std::nullopt);
}

void Viewport::update(const PointerState& p, const ViewportScene& scene, View& view,
                      ActionQueue& actions) {
  const PointerFrame frame{p, scene, view, actions};
  picker_ = &plane_;
  if (scene.session.in_space()) picker_ = &space_;
  if (gesture_ == Gesture::none) hover(frame);
  if (p.over && p.wheel != 0 && !scene.wheel_is_lens) wheel(frame);
  const bool pressed =
      (p.left && !last_.left) || (p.middle && !last_.middle) || (p.right && !last_.right);
  if (gesture_ == Gesture::move) {
    follow_move(frame);
  } else if (gesture_ == Gesture::none) {
    if (p.over && pressed) press(frame);
  } else if (p.cancel) {
    cancel(frame);
  } else {
    drag(frame);
    last_.position = p.position;
    const bool held = other_button_ ? p.middle || p.right : p.left;
    if (!held && gesture_ != Gesture::move) release(frame);
  }
  last_ = p;
}

std::optional<ScreenBox> Viewport::box() const {
  if (gesture_ != Gesture::box) return std::nullopt;
  const ScreenPoint &a = press_, &b = last_.position;
  return ScreenBox{{std::min(a.x(), b.x()), std::min(a.y(), b.y())},
                   {std::max(a.x(), b.x()), std::max(a.y(), b.y())}};
}

CutPart Viewport::cut_part() const {
  return gesture_ == Gesture::none || gesture_ == Gesture::cut ? cut_.part() : CutPart::none;
}

std::optional<Vec3> Viewport::orbit_centre() const {
  return gesture_ == Gesture::orbit ? std::optional(centre_) : std::nullopt;
}

void Viewport::hover(const PointerFrame& frame) {
  mover_.hover(frame);
  cut_.leave();
  if (frame.pointer.over && !mover_.handle()) cut_.hover(frame);
  picker_->look(frame, mover_.handle() || cut_.part() != CutPart::none);
}

void Viewport::wheel(const PointerFrame& frame) {
  if (mover_.shapes()) return turn_radius(frame, mover_.gesture().pivot());
  if (gesture_ == Gesture::cut) return;
  // The point under the mouse stays there.
  Vec3 depth = dragging() ? mover_.gesture().pivot() : centre_;
  std::optional<Vec3> there;
  if (gesture_ == Gesture::none) {
    there = picker_->point(frame);
    if (!there) depth = picker_->middle(frame);
  }
  if (!there) there = frame.view.at_depth_of(depth, frame.pointer.position);
  frame.view.zoom_about(*there, std::pow(zoom_per_notch, frame.pointer.wheel));
}

void Viewport::press(const PointerFrame& frame) {
  const PointerState& p = frame.pointer;
  press_ = last_.position = p.position;
  clicks_ = true;
  other_button_ = !p.left;
  view_before_ = frame.view.looked_at();
  const auto there = picker_->point(frame);
  centre_ = there ? *there : picker_->middle(frame);
  if ((p.left && frame.scene.box_zoom) || (p.right && p.control))
    gesture_ = Gesture::box;
  else if (!other_button_ && mover_.handle())
    take_handle(frame);
  else if (other_button_ || (p.shift && frame.view.turns()))
    gesture_ = Gesture::pan;
  else
    gesture_ = cut_.press(frame) ? Gesture::cut : Gesture::press;
}

void Viewport::take_handle(const PointerFrame& frame) {
  const auto gizmo = mover_.gizmo(frame.scene, frame.view);
  if (!gizmo) return;
  Handle handle = mover_.handle();
  const Handle pin{Handle::Kind::pin, 0};
  if (handle.kind == Handle::Kind::centre && frame.pointer.alt && gizmo->has(pin)) handle = pin;
  if (handle == pin) {
    gesture_ = Gesture::pivot;
    pivot_before_ = gizmo->place.pivot;
  } else {
    gesture_ = Gesture::move;
    mover_.begin(handle, *gizmo, press_, frame);
  }
}

/// Called when the mouse is so far from the press that it is no click.
void Viewport::leave_press(const PointerFrame& frame) {
  last_.position = press_;
  gesture_ = frame.view.turns() ? Gesture::orbit : Gesture::pan;
  const auto taken = picker_->grab(frame);
  if (!taken) return;
  mover_.grab(*taken, press_, frame);
  if (!mover_.dragging()) return;
  gesture_ = Gesture::move;
  follow_move(frame);
}

void Viewport::drag(const PointerFrame& frame) {
  const PointerState& p = frame.pointer;
  if ((p.position - press_).norm() > drag_threshold * frame.scene.scale) {
    if (gesture_ == Gesture::press) leave_press(frame);
    clicks_ = false;
  }
  const ScreenVector by = p.position - last_.position;
  if (gesture_ == Gesture::orbit)
    frame.view.turn(centre_, by, frame.scene.options.space.free_orbit);
  else if (gesture_ == Gesture::pan)
    frame.view.pan_at(centre_, by);
  else if (gesture_ == Gesture::pivot)
    follow_pivot(frame);
  else if (gesture_ == Gesture::cut && by != ScreenVector())
    cut_.drag(frame);
}

void Viewport::follow_move(const PointerFrame& frame) {
  const PointerState& p = frame.pointer;
  if ((p.position - press_).norm() > drag_threshold * frame.scene.scale) clicks_ = false;
  mover_.drag(frame, last_);
  picker_->look_again();
  if (mover_.dragging()) return;
  // A click on a handle also counts for the node behind it.
  if (clicks_ && !p.left && !p.cancel && !p.click_taken) picker_->inspect(frame);
  done();
}

void Viewport::follow_pivot(const PointerFrame& frame) {
  const PointerState& p = frame.pointer;
  if (p.position == last_.position && p.control == last_.control) return;
  const auto placing = PlanePicker::place_pivot(frame);
  snapped_to_ = placing.snapped_to;
  frame.actions.emplace_back(action::SetPivot{placing.at, {}});
}

void Viewport::release(const PointerFrame& frame) {
  if (gesture_ == Gesture::box) {
    const ScreenBox pixels = *box();
    // A click is no box.
    if (std::min(pixels.size().x(), pixels.size().y()) > drag_threshold)
      frame.actions.emplace_back(action::ZoomToScreen{pixels, centre_});
  } else if (clicks_ && !frame.pointer.click_taken) {
    // With Shift the left button pans, or adds what is clicked.
    if (gesture_ == Gesture::press || (gesture_ == Gesture::pan && !other_button_))
      picker_->click(frame);
    else if (gesture_ == Gesture::pivot)
      picker_->inspect(frame);
  }
  done();
}

void Viewport::cancel(const PointerFrame& frame) {
  if (gesture_ == Gesture::orbit || gesture_ == Gesture::pan) frame.view.look_at(view_before_);
  if (gesture_ == Gesture::cut) cut_.put_back(frame);
  if (gesture_ == Gesture::pivot)
    frame.actions.emplace_back(action::SetPivot{Vec2(pivot_before_.head<2>()), {}});
  done();
}

void Viewport::done() {
  gesture_ = Gesture::none;
  snapped_to_.clear();
  picker_->look_again();
}

}  // namespace winslow::gui
