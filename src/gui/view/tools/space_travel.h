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

}  // namespace winslow::gui
