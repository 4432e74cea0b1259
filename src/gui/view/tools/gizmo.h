#pragma once

#include "gui/render/view.h"

/// Converts movements of the mouse on screen to motions in space. Along a direction that is seen
/// end on, a motion is at most a few times as fast as the mouse.
namespace winslow::gui {

/// Unit vector from a point towards the viewer.
Vec3 towards_viewer(const View& view, const Vec3& point);

/// Distance along a line through a point, in mesh units, that keeps what was under the mouse under
/// it. If the line is seen end on, up on screen is forwards. direction: of length 1.
double travel_along(const View& view, const Vec3& point, const Vec3& direction,
                    const ScreenPoint& from, const ScreenPoint& to);

/// The same as a vector in a plane through a point. If the plane is seen edge on, the vector lies
/// along the line as which the plane appears. normal: of length 1.
Vec3 travel_in_plane(const View& view, const Vec3& point, const Vec3& normal,
                     const ScreenPoint& from, const ScreenPoint& to);

/// Angle, -180 to 180 degrees, by which the mouse turns a ring about an axis through a point: the
/// angle of the mouse about the centre or, if the ring is seen edge on, its way along the near
/// side. radius: of the ring, pixels.
double turn_about(const View& view, const Vec3& point, const Vec3& axis, double radius,
                  const ScreenPoint& from, const ScreenPoint& to);

/// The handle that moves a selection: arrows, squares, rings and a centre. In the plane, it lacks
/// the parts whose motions lead out of the plane.
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
  /// The third axis is a picked axis or a normal, not one of the mesh's axes.
  bool aligned = false;
  const char* third = "axis";  ///< name of the third axis

  /// The frame of the mesh if `axis` is one of its axes; else a frame whose third axis is `axis`.
  static GizmoFrame about(const Vec3& axis, const char* name = "axis");
  /// Name of an axis: "x", "y" or "z"; or "u", "v" and the name of the third one.
  const char* name(int axis) const;
};

/// Where a gizmo is in the mesh, and which motions it offers.
struct GizmoPlace {
  Vec3 pivot{0, 0, 0};
  GizmoFrame frame = {};
  bool turns = true;      ///< it has rings
  bool in_plane = false;  ///< nothing leads out of the plane z = 0
  // In the plane the ring lies around what is selected, with a knob on it.
  double reach = 0;   ///< of the selection around its pivot, units of the mesh
  double turned = 0;  ///< degrees by which a drag has turned it so far
};

/// A gizmo on screen, in framebuffer pixels. In space, its size does not depend on its distance
/// from the viewer.
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
  /// Handles that can be grabbed: not an arrow that points at the viewer, nor a square seen edge
  /// on. Where handles overlap, the first one is meant; of rings, the nearest.
  std::vector<Handle> handles;

  bool has(const Handle& handle) const;
  Handle handle_at(const ScreenPoint& pixel) const;
  const GizmoFrame& frame() const { return place.frame; }

 private:
  double distance(const Handle& handle, const ScreenPoint& pixel) const;
};

/// None if the pivot lies behind the viewer.
std::optional<Gizmo> make_gizmo(const View& view, const GizmoPlace& place, double scale);
/// Place on screen of a point of a ring about an axis, turned by an angle (degrees) from a
/// direction across the axis. radius: pixels.
ScreenPoint on_ring(const View& view, const Vec3& pivot, const Vec3& axis, const Vec3& from,
                    double angle, double radius);

}  // namespace winslow::gui
