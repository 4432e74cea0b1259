#pragma once

#include <array>
#include <optional>

#include "core/motion/motion.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/space_gizmo.h"

namespace winslow::gui {

/// The motion that the mouse describes while it drags a handle of the gizmo in space.
class SpaceGesture {
 public:
  using Modifiers = MotionGesture::Modifiers;

  /// from: where the mouse is.
  void begin(const SpaceHandle& handle, const ScreenPoint& from, const SpaceGizmo& gizmo,
             const View& view);
  /// The mouse went to a place. True if that changed the motion.
  bool follow(const ScreenPoint& mouse, Modifiers modifiers, const View& view);
  /// Takes the motion from typed numbers: degrees, or units of the mesh along each of
  /// directions(). True if that changed the motion.
  bool type(const TypedMotion& typed);
  std::size_t typed_fields() const { return turns() ? 1 : directions().size(); }
  /// Keeps a move to an axis of the mesh, or turns about it, 0 to 2; the same one again goes back
  /// to what the handle does.
  void toggle_axis(int axis, const View& view);

  bool turns() const {
    return handle_.kind == SpaceHandle::Kind::ring ||
           handle_.kind == SpaceHandle::Kind::screen_ring;
  }
  const SpaceHandle& handle() const { return handle_; }
  /// An axis of the mesh that it is kept to.
  std::optional<int> locked() const { return locked_; }
  /// A direction along which it moves, and what it is called: "x".
  struct Direction {
    Vec3 along;
    const char* name;
  };
  /// One to three of them.
  std::vector<Direction> directions() const;
  /// "x", "the axis", "the line of sight".
  const char* axis_name() const;
  /// Of the rotation, of length 1.
  Vec3 axis() const;
  /// The direction, across the axis, in which the ring was taken.
  const Vec3& grip() const { return grip_; }

  const RigidMotion& motion() const { return motion_; }
  bool snapped() const { return modifiers_.snap; }
  /// Round length to which moves snap.
  double snap_step(const View& view) const {
    return MotionGesture::grid_step(view, *motion_.pivot);
  }

 private:
  RigidMotion moved_to(const View& view) const;
  void find_grip(const View& view);

  SpaceHandle handle_;
  GizmoFrame frame_;
  double radius_ = 1;  // of the ring, pixels
  Vec3 viewer_{0, 0, 1};
  std::optional<int> locked_;
  Modifiers modifiers_;
  RigidMotion motion_{.axis = Vec3(0, 0, 1)};
  Vec3 grip_{1, 0, 0};
  ScreenPoint press_, last_;
  ScreenPoint slowed_;  // where the mouse would be had it gone at the speed that fine motion has
  double turned_ = 0;   // by the mouse, degrees, past half turns
};

}  // namespace winslow::gui
