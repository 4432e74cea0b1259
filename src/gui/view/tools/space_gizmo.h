#pragma once

#include <array>
#include <optional>
#include <vector>

#include "gui/render/view.h"

namespace winslow::gui {

/// A part of the gizmo with which a selection is moved in space.
struct SpaceHandle {
  enum class Kind {
    none,
    centre,      ///< moves across the view
    arrow,       ///< moves along an axis
    square,      ///< moves in the plane across an axis
    ring,        ///< turns about an axis
    screen_ring  ///< turns about the line to the viewer
  };
  Kind kind = Kind::none;
  int axis = 0;  ///< of arrow, square and ring, 0 to 2

  explicit operator bool() const { return kind != Kind::none; }
  bool operator==(const SpaceHandle&) const = default;
};

/// The directions of a gizmo, of length 1, at right angles, right-handed.
struct GizmoFrame {
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  /// The third is a picked axis or a normal, which is none of the mesh's own.
  bool aligned = false;
  const char* third = "axis";  ///< what that one is called

  /// That of the mesh if the axis is one of its own; else one whose third axis it is.
  static GizmoFrame about(const Vec3& axis, const char* name = "axis");
  /// "x", or "u", "v" and the third one's name.
  const char* name(int axis) const;
};

/// Where the gizmo of a selection is on screen, in framebuffer pixels; its size does not depend on
/// how near it is.
struct SpaceGizmo {
  /// A part of a ring, which is drawn as lines from point to point.
  struct RingPoint {
    ScreenPoint at;
    bool front = true;  ///< on the viewer's side of the centre
  };

  Vec3 pivot{0, 0, 0};
  GizmoFrame frame;
  bool turns = true;     ///< it has rings
  double scale = 1;      ///< of the interface
  Vec3 viewer{0, 0, 1};  ///< of length 1, from the pivot
  ScreenPoint centre;
  std::array<ScreenPoint, 3> shafts, tips;            ///< of the arrows: begin and end
  std::array<std::array<ScreenPoint, 4>, 3> squares;  ///< corners
  std::array<std::vector<RingPoint>, 3> rings;        ///< closed
  double ring_radius = 0, screen_radius = 0;          ///< pixels

  /// An arrow that points at the viewer, and a square that is seen edge on, cannot be taken.
  bool takes_arrow(int axis) const;
  bool takes_square(int axis) const;
  SpaceHandle at(const ScreenPoint& pixel) const;
};

/// None if the pivot lies behind the viewer.
std::optional<SpaceGizmo> make_space_gizmo(const View& view, const Vec3& pivot,
                                           const GizmoFrame& frame, bool turns, double scale);
/// Where a point of a ring about an axis is, turned by an angle (degrees) from a direction across
/// the axis. radius: pixels.
ScreenPoint on_ring(const View& view, const Vec3& pivot, const Vec3& axis, const Vec3& from,
                    double angle, double radius);

}  // namespace winslow::gui
