#pragma once

#include <optional>

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/view/tools/space_gesture.h"
#include "gui/view/tools/space_gizmo.h"
#include "gui/view/tools/typed_motion.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// Moves what is selected in a volume mesh: whole bodies, or while shapes are edited what is held
/// of the boundary. Takes its handle with the mouse and turns that into actions.
class SpaceMover {
 public:
  /// Looks at what is under the mouse, which drags nothing. scale: of the interface.
  void hover(const PointerState& pointer, const Session& session, const View& view, double scale);
  void leave() { hovered_ = {}; }
  /// Begins a drag with the handle under the mouse. False if there is none.
  bool press(const PointerState& pointer, const Session& session, const View& view, double scale,
             ActionQueue& actions);
  /// Begins to drag a point of the boundary, which is part of what is held, across the view.
  void take(const Vec3& point, const ScreenPoint& from, const Session& session, const View& view,
            double scale, ActionQueue& actions);
  /// A frame of the drag; ends it with Enter, Esc or when the button is let go of.
  void follow(const PointerState& pointer, const PointerState& before, const View& view,
              ActionQueue& actions);

  bool dragging() const { return dragging_; }
  /// Under the mouse, or held.
  const SpaceHandle& handle() const { return dragging_ ? gesture_.handle() : hovered_; }
  /// The drag so far.
  const SpaceGesture& gesture() const { return gesture_; }
  /// Numbers typed during the drag, which count in place of the mouse.
  const TypedMotion& typed() const { return typed_; }

  /// Where the handle is now; none: there is nothing to move, or it lies behind the viewer.
  std::optional<SpaceGizmo> gizmo(const Session& session, const View& view, double scale) const;

 private:
  void begin(const SpaceHandle& handle, const SpaceGizmo& gizmo, const ScreenPoint& from,
             const Session& session, const View& view, ActionQueue& actions);
  void end(bool cancelled, ActionQueue& actions);
  bool take_typed(const PointerState& pointer, const PointerState& before, const View& view);

  bool dragging_ = false;
  SpaceHandle hovered_;
  SpaceGesture gesture_;
  GizmoFrame frame_;  // of the drag: it does not turn with the body
  TypedMotion typed_;
};

}  // namespace winslow::gui
