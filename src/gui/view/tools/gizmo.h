#pragma once

#include <optional>

#include "gui/render/view.h"

namespace winslow::gui {

/// The parts of the gizmo with which a selection is moved.
enum class Handle {
  none,
  centre,   ///< moves freely
  arrow_x,  ///< moves along x
  arrow_y,  ///< moves along y
  ring,     ///< turns about the pivot
  pivot     ///< a pin beside the centre: puts the pivot elsewhere
};

/// Where the gizmo of the selection is on screen; lengths in framebuffer pixels.
struct Gizmo {
  ScreenPoint pivot;
  double radius = 0;  ///< of the ring
  double angle = 0;   ///< of the knob on the ring, radians, counter-clockwise on screen
  double scale = 1;   ///< of the interface

  ScreenPoint knob() const;
  /// Where the shaft of an arrow begins and ends. axis: 0 for x, 1 for y.
  ScreenPoint shaft(int axis) const;
  ScreenPoint tip(int axis) const;
  ScreenPoint pin() const;
  Handle at(const ScreenPoint& pixel) const;
};

/// reach: of the selection around its pivot, in units of the mesh. turned: degrees by which a drag
/// has turned it so far.
Gizmo make_gizmo(const View& view, const Vec2& pivot, double reach, double turned, double scale);

}  // namespace winslow::gui
