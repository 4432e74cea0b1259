#pragma once

#include "gui/document/selection/pivot.h"
#include "gui/view/tools/gizmo.h"

namespace winslow::gui {

/// Numbers typed while the mouse drags a body: "30" turns it by 30 degrees, "0.1 Tab 0.2" moves it
/// by (0.1, 0.2), in space "0.1 Tab 0.2 Tab 0.3". Typed numbers replace the motion of the mouse.
class TypedMotion {
 public:
  void clear() { *this = TypedMotion(); }
  /// Appends the digits, signs and points of a text (a comma is a point), and ignores the rest.
  /// True if it appended any.
  bool type(std::u32string_view text);
  /// Deletes the last character; in an empty field, returns to the previous field.
  bool erase();
  /// Moves to the next of `count` fields, from the last one to the first.
  void next(std::size_t count);

  bool active() const {
    return std::ranges::any_of(fields_, [](const std::string& text) { return !text.empty(); });
  }
  /// Text of a field as typed.
  const std::string& text(std::size_t field) const { return fields_[field]; }
  std::size_t field() const { return at_; }
  /// Value of a field: 0 if it is empty; none if it is not (yet) a number, such as "-".
  std::optional<double> value(std::size_t field) const;

 private:
  std::array<std::string, 3> fields_;
  std::size_t at_ = 0;
};

/// The motion that the mouse describes while it drags a handle.
///
///     gesture.begin({Handle::Kind::arrow, 0}, mouse, gizmo, view);
///     if (gesture.follow(mouse, {.fine = shift, .snap = control}, view)) use(gesture.motion());

class MotionGesture {
 public:
  struct Modifiers {
    bool fine = false;  ///< a tenth of the speed
    bool snap = false;  ///< to round lengths, or to steps of 5 degrees
  };

  /// from: where the mouse is.
  void begin(const Handle& handle, const ScreenPoint& from, const Gizmo& gizmo, const View& view);
  /// Updates the motion for a new place of the mouse. True if the motion changed.
  bool drag_to(const ScreenPoint& mouse, Modifiers modifiers, const View& view);
  /// Sets the motion from typed numbers: degrees, or units of the mesh along each of directions().
  /// True if the motion changed.
  bool type(const TypedMotion& typed);
  std::size_t typed_fields() const { return turns() ? 1 : directions().size(); }
  /// Restricts a move, or the axis of a turn, to an axis of the mesh, 0 to 2; the same axis again
  /// lifts the restriction. Has no effect where the motion would leave the plane.
  void toggle_axis(int axis, const View& view);

  bool turns() const {
    return handle_.kind == Handle::Kind::ring || handle_.kind == Handle::Kind::screen_ring;
  }
  /// The grabbed handle.
  const Handle& handle() const { return handle_; }
  /// The handle that represents the present motion: an arrow while a move is restricted to an axis.
  Handle shown_handle() const;
  /// The axis of the mesh to which the motion is restricted; none: it is free.
  std::optional<int> locked() const { return locked_; }
  /// A direction of a move, and its name, such as "x".
  struct Direction {
    Vec3 along;
    const char* name;
  };
  /// The one to three directions of a move.
  std::vector<Direction> directions() const;
  /// Name of the axis of rotation: "x", "the axis", "the line of sight"; empty in the plane, where
  /// there is only one.
  const char* axis_name() const;
  /// Axis of the rotation, of length 1.
  Vec3 axis() const;
  /// The direction, across the axis, in which the ring was grabbed.
  const Vec3& grip() const { return grip_; }

  // Total, since begin().
  double rotate() const { return now_.rotate; }  ///< degrees
  const Vec3& translate() const { return now_.translate; }
  const Vec3& pivot() const { return pivot_; }
  RigidMotion motion() const {
    return motion_of(in_plane_, now_.rotate, now_.translate, pivot_, now_.axis);
  }
  bool snapped() const { return modifiers_.snap; }
  /// Round length to which moves snap.
  double snap_step(const View& view) const { return grid_step(view, pivot_); }
  /// Step of the grid: a round number of mesh units that is 8 to 20 pixels on screen at a
  /// point.
  static double grid_step(const View& view, const Vec3& at);

 private:
  struct Way {
    double rotate = 0;
    Vec3 translate{0, 0, 0};
    Vec3 axis{0, 0, 1};
    bool operator==(const Way&) const = default;
  };
  bool set_way(const Way& next);
  Vec3 moved_to(const View& view) const;
  void find_grip(const View& view, const ScreenPoint& press);

  Handle handle_;
  GizmoFrame frame_;
  bool in_plane_ = false;
  double radius_ = 1;  // of the ring, pixels
  Vec3 viewer_{0, 0, 1};
  Vec3 pivot_{0, 0, 0};
  std::optional<int> locked_;
  Modifiers modifiers_;
  Way now_;
  Vec3 grip_{1, 0, 0};
  ScreenPoint last_;
  // Points at the depth of the pivot, so that the view may change during the drag: where the mouse
  // was pressed, and where it would be now if fine motion slowed down the mouse itself.
  Vec3 from_{0, 0, 0}, to_{0, 0, 0};
  double turned_ = 0;  // angle by the mouse, degrees, not limited to half turns
};

}  // namespace winslow::gui
