#pragma once

#include "gui/render/view.h"

/// What the mouse means in space when it goes from one place to another. A thing that is seen end
/// on moves no faster than a few times what the mouse does.
namespace winslow::gui {

/// Of length 1, from a point towards the viewer.
Vec3 towards_viewer(const View& view, const Vec3& point);

/// How far along a line through a point, units of the mesh, such that what was under the mouse
/// stays under it. Seen end on, up on screen is forwards. direction: of length 1.
double travel_along(const View& view, const Vec3& point, const Vec3& direction,
                    const ScreenPoint& from, const ScreenPoint& to);

/// The same in a plane through a point. Seen edge on, along the line that is its picture. normal:
/// of length 1.
Vec3 travel_in_plane(const View& view, const Vec3& point, const Vec3& normal,
                     const ScreenPoint& from, const ScreenPoint& to);

/// By how many degrees a ring about an axis through a point is turned, between -180 and 180: as the
/// mouse goes around its centre, or, seen edge on, along its near side. radius: of the ring,
/// pixels.
double turn_about(const View& view, const Vec3& point, const Vec3& axis, double radius,
                  const ScreenPoint& from, const ScreenPoint& to);

/// The handle with which a selection is moved: arrows, squares, rings and a centre in space; in the
/// plane those of them that lead out of it are left out.
///
///     const auto gizmo = make_gizmo(view, {.pivot = Vec3(0.5, 0, 0), .in_plane = true}, 1);
///     const Handle taken = gizmo->handle_at(mouse);

/// A part of a gizmo.
struct Handle {
  enum class Kind {
    none,
    centre,       ///< moves across the view
    arrow,        ///< moves along an axis
    square,       ///< moves in the plane across an axis
    ring,         ///< turns about an axis
    screen_ring,  ///< turns about the line to the viewer
    pin           ///< beside the centre: puts the pivot elsewhere
  };
  Kind kind = Kind::none;
  int axis = 0;  ///< of arrow, square and ring, 0 to 2

  explicit operator bool() const { return kind != Kind::none; }
  bool operator==(const Handle&) const = default;
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

/// What a gizmo is for.
struct GizmoPlace {
  Vec3 pivot{0, 0, 0};
  GizmoFrame frame = {};
  bool turns = true;      ///< it has rings
  bool in_plane = false;  ///< nothing leads out of the plane z = 0
  // In the plane the ring lies around what is selected, with a knob on it.
  double reach = 0;   ///< of the selection around its pivot, units of the mesh
  double turned = 0;  ///< degrees by which a drag has turned it so far
};

/// Where a gizmo is on screen, in framebuffer pixels. In space its size does not depend on how near
/// it is.
struct Gizmo {
  /// A part of a ring, which is drawn as lines from point to point.
  struct RingPoint {
    ScreenPoint at;
    bool front = true;  ///< on the viewer's side of the centre
  };

  GizmoPlace place;
  double scale = 1;      ///< of the interface
  Vec3 viewer{0, 0, 1};  ///< of length 1, from the pivot
  ScreenPoint centre;
  std::array<ScreenPoint, 3> shafts, tips;            ///< of the arrows: begin and end
  std::array<std::array<ScreenPoint, 4>, 3> squares;  ///< corners
  std::array<std::vector<RingPoint>, 3> rings;        ///< closed
  double ring_radius = 0, screen_radius = 0;
  std::optional<ScreenPoint> knob, pin;
  /// That can be taken, but for an arrow that points at the viewer and a square that is seen edge
  /// on. Where they overlap, the first one is meant; of rings, the nearest.
  std::vector<Handle> handles;

  bool has(const Handle& handle) const;
  Handle handle_at(const ScreenPoint& pixel) const;
  const GizmoFrame& frame() const { return place.frame; }

 private:
  double distance(const Handle& handle, const ScreenPoint& pixel) const;
};

/// None if the pivot lies behind the viewer.
std::optional<Gizmo> make_gizmo(const View& view, const GizmoPlace& place, double scale);
/// Where a point of a ring about an axis is, turned by an angle (degrees) from a direction across
/// the axis. radius: pixels.
ScreenPoint on_ring(const View& view, const Vec3& pivot, const Vec3& axis, const Vec3& from,
                    double angle, double radius);

}  // namespace winslow::gui
