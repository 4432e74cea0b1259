#pragma once

#include <variant>

#include "core/motion/motion.h"
#include "core/motion/rigid_motion.h"

/// Motions and changes of shape, typed or under the mouse. Carried out by Motions.
namespace winslow::gui::action {

/// In the plane or in space, as the open mesh is.
struct ApplyMotion {
  RigidMotionRequest motion;
};
struct ApplyDeformation {
  SineDeformation shape;
};
/// Shape editing on or off, and how far a drag fades along the boundary, units of the mesh.
struct SetShapeEdit {
  bool active = false;
  double radius = 0;
};
/// A motion under the mouse: the mesh follows every DragTo until EndDrag. Motions are total, seen
/// from BeginDrag.
struct BeginDrag {
  bool shape = false;  ///< the arc or patch of the shape edit instead of the selected bodies
};
struct DragTo {
  RigidMotionRequest motion;  ///< as the open mesh is; it names its pivot
};
struct EndDrag {};
struct CancelDrag {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using MotionAction =
    std::variant<action::ApplyMotion, action::ApplyDeformation, action::SetShapeEdit,
                 action::BeginDrag, action::DragTo, action::EndDrag, action::CancelDrag>;

}  // namespace winslow::gui
