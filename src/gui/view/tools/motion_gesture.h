#pragma once

#include <optional>

#include "core/motion/motion.h"
#include "gui/render/view.h"
#include "gui/view/tools/typed_motion.h"

namespace winslow::gui {

/// The motion that the mouse describes while it drags a body, a handle or a piece of boundary.
class MotionGesture {
 public:
  enum class Kind { move, rotate };
  struct Modifiers {
    bool fine = false;  ///< a tenth of the speed
    bool snap = false;  ///< to the grid, or to steps of 5 degrees
  };

  /// from: where the mouse is. pivot: in units of the mesh. axis: 0 or 1 keeps a move to x or y.
  void begin(Kind kind, const ScreenPoint& from, const Vec2& pivot, std::optional<int> axis);
  /// The mouse went to a place. True if that changed the motion.
  bool follow(const ScreenPoint& mouse, Modifiers modifiers, const View& view);
  /// Takes the motion from typed numbers: degrees, or units of the mesh along x and y, or along the
  /// one axis that the move is kept to. True if that changed the motion.
  bool type(const TypedMotion& typed);
  /// How many numbers there are to type.
  std::size_t typed_fields() const { return kind_ == Kind::rotate || axis_ ? 1 : 2; }
  /// Keeps a move to an axis; the same one again sets it free.
  void toggle_axis(int axis);

  Kind kind() const { return kind_; }
  std::optional<int> axis() const { return axis_; }
  /// Total, since begin().
  const RigidMotion& motion() const { return motion_; }
  bool snapped() const { return modifiers_.snap; }
  /// Step of the grid: a round number of mesh units that is 8 to 20 pixels on screen at a
  /// point.
  static double grid_step(const View& view, const Vec2& at) {
    return grid_step(view, Vec3(at.x(), at.y(), 0));
  }
  static double grid_step(const View& view, const Vec3& at);

 private:
  Kind kind_ = Kind::move;
  std::optional<int> axis_;
  Modifiers modifiers_;
  RigidMotion motion_;
  ScreenPoint last_;
  Vec2 moved_{0, 0};   // by the mouse, units of the mesh
  double turned_ = 0;  // by the mouse, degrees, unwrapped
};

}  // namespace winslow::gui
