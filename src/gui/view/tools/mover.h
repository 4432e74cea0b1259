#pragma once

#include "gui/view/tools/gizmo.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/pointer.h"

namespace winslow::gui {

/// Moves what is selected: whole bodies, or while shapes are edited what is held of the boundary.
/// Takes its handle with the mouse and turns that into actions.
class Mover {
 public:
  /// Looks at what is under the mouse, which drags nothing.
  void hover(const PointerFrame& frame);
  /// Begins a drag with a handle of a gizmo.
  void begin(const Handle& handle, const Gizmo& gizmo, const ScreenPoint& from,
             const PointerFrame& frame);
  /// Begins to drag what lies at a point across the view: a body, or what is held of the boundary.
  void grab(const Vec3& point, const ScreenPoint& from, const PointerFrame& frame);
  /// A frame of the drag; ends it with Enter, Esc or when the button is let go of. before: the
  /// mouse in the frame before.
  void drag(const PointerFrame& frame, const PointerState& before);

  bool dragging() const { return dragging_; }
  /// What is dragged is a part of the boundary.
  bool shapes() const { return dragging_ && shape_; }
  /// Under the mouse, or standing for what the drag does.
  Handle handle() const { return dragging_ ? gesture_.shown_handle() : hovered_; }
  /// The drag so far.
  const MotionGesture& gesture() const { return gesture_; }
  /// Numbers typed during the drag, which count in place of the mouse.
  const TypedMotion& typed() const { return typed_; }

  /// Where the handle is now; none: there is nothing to move, or it lies behind the viewer.
  std::optional<Gizmo> gizmo(const ViewportScene& scene, const View& view) const;

 private:
  void end(bool cancelled, ActionQueue& actions);
  bool take_typed(const PointerFrame& frame, const PointerState& before);

  bool dragging_ = false, shape_ = false;
  Handle hovered_;
  MotionGesture gesture_;
  GizmoFrame frame_;  // of the drag: it does not turn with the body
  TypedMotion typed_;
};

}  // namespace winslow::gui
