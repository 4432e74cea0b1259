#pragma once

#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/view/tools/pointer.h"

namespace winslow::gui {

/// The parts of a cut's handle.
enum class CutPart {
  none,
  shaft,  ///< moves the cut along its normal
  knob    ///< turns it about its point
};

/// The handle of a cut: an arrow along its normal, from a point of the plane into the part that is
/// cut away.
struct CutHandle {
  Vec3 anchor{0, 0, 0};   ///< on the plane
  Vec3 normal{0, 0, 1};   ///< of length 1
  double length = 1;      ///< of the arrow, units of the mesh
  ScreenPoint foot, tip;  ///< the ends of the arrow
  double scale = 1;       ///< of the interface

  CutPart part_at(const ScreenPoint& pixel) const;
};
/// The cut that has a handle; null: none has.
const CutPlane* held_cut(const ViewportScene& scene);
CutHandle make_cut_handle(const CutPlane& cut, const View& view, double scale);

/// The cut after a drag of its handle. handle, cut: their state when the drag began.
CutPlane moved_cut(const CutPlane& cut, const CutHandle& handle, const View& view,
                   const ScreenVector& by);
CutPlane turned_cut(const CutPlane& cut, const CutHandle& handle, const View& view,
                    const ScreenPoint& to);

/// Drags the handle of a cut with the mouse.
class CutTool {
 public:
  void hover(const PointerFrame& frame);
  void leave() { part_ = CutPart::none; }
  /// Begins a drag with the part under the mouse. False if there is none.
  bool press(const PointerFrame& frame);
  /// Moves or turns the cut to follow the mouse.
  void drag(const PointerFrame& frame) const;
  /// Restores the cut from before the drag.
  void put_back(const PointerFrame& frame) const;
  /// The part under the mouse, or held.
  CutPart part() const { return part_; }

 private:
  CutPart part_ = CutPart::none;
  ScreenPoint press_;
  CutHandle handle_;  // when the drag began
  CutPlane before_;   // likewise
};

}  // namespace winslow::gui
