#pragma once

#include "gui/view/tools/gizmo.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/pointer.h"

namespace winslow::gui {

/// Moves the selection: whole bodies, or the held part of the boundary while shapes are edited.
/// Turns drags of its handle with the mouse into actions.
class Mover {
 public:
  /// Finds the handle under the mouse while nothing is dragged.
  void hover(const PointerFrame& frame);
  /// Begins a drag with a handle of a gizmo.
  void begin(const Handle& handle, const Gizmo& gizmo, const ScreenPoint& from,
             const PointerFrame& frame);
  /// Begins to drag what lies at a point, parallel to the screen: a body, or the held part of the
  /// boundary.
  void grab(const Vec3& point, const ScreenPoint& from, const PointerFrame& frame);
  /// Continues the drag by a frame. Enter, Esc or release of the button end it. before: the mouse
  /// in the previous frame.
  void drag(const PointerFrame& frame, const PointerState& before);

  bool dragging() const { return dragging_; }
  /// A part of the boundary is being dragged.
  bool shapes() const { return dragging_ && shape_; }
  /// The handle under the mouse, or the one that represents the motion of the drag.
  Handle handle() const { return dragging_ ? gesture_.shown_handle() : hovered_; }
  /// The drag so far.
  const MotionGesture& gesture() const { return gesture_; }
  /// Numbers typed during the drag, which count in place of the mouse.
  const TypedMotion& typed() const { return typed_; }

  /// The handle at its present place; none: there is nothing to move, or it lies behind the viewer.
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
