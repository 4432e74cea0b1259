#pragma once

#include "gui/view/tools/cut_handle.h"
#include "gui/view/tools/mover.h"
#include "gui/view/tools/plane_picker.h"
#include "gui/view/tools/space_picker.h"

namespace winslow::gui {

/// Detects clicks of the right button, which open a menu; a drag with that button pans.
class ContextClick {
 public:
  /// The place clicked, in the frame in which the button is released there; none: no click. scale:
  /// of the interface.
  std::optional<ScreenPoint> update(const PointerState& pointer, double scale);

 private:
  std::optional<ScreenPoint> press_;
  bool was_down_ = false;
};

/// Turns input of the mouse over the mesh into actions: selects, drags bodies, handles, parts of
/// the boundary and cuts; turns, pans and zooms the view. Independent of OpenGL and of widgets.
///
///     viewport.update(pointer, scene, view, actions);  // in every frame
class Viewport {
 public:
  void update(const PointerState& pointer, const ViewportScene& scene, View& view,
              ActionQueue& actions);

  enum class Gesture { none, press, orbit, pan, box, move, pivot, cut };
  Gesture gesture() const { return gesture_; }
  /// A body, a handle or a piece of boundary is being dragged.
  bool dragging() const { return gesture_ == Gesture::move; }
  /// The mouse changes the view or the box to zoom to.
  bool looks_around() const {
    return gesture_ == Gesture::orbit || gesture_ == Gesture::pan || gesture_ == Gesture::box;
  }
  /// The box being drawn to zoom to.
  std::optional<ScreenBox> box() const;
  /// The mouse is over the mesh, with nothing of the interface in between.
  bool over() const { return last_.over; }
  /// The handle of what is selected.
  const Mover& mover() const { return mover_; }
  /// What lies under the mouse, while nothing is dragged.
  const MeshPicker& picker() const { return *picker_; }
  MeshPicker& picker() { return *picker_; }
  /// The part of a cut's handle that is under the mouse, or held.
  CutPart cut_part() const;
  /// The point about which the view is turned just now.
  std::optional<Vec3> orbit_centre() const;
  /// What the pivot under the mouse has snapped to; empty: nothing.
  const std::string& snapped_to() const { return snapped_to_; }

 private:
  void hover(const PointerFrame& frame);
  void wheel(const PointerFrame& frame);
  void press(const PointerFrame& frame);
  void take_handle(const PointerFrame& frame);
  void leave_press(const PointerFrame& frame);
  void drag(const PointerFrame& frame);
  void follow_move(const PointerFrame& frame);
  void follow_pivot(const PointerFrame& frame);
  void release(const PointerFrame& frame);
  void cancel(const PointerFrame& frame);
  void done();

  PlanePicker plane_;
  SpacePicker space_;
  MeshPicker* picker_ = &plane_;  // of the open mesh
  Mover mover_;
  CutTool cut_;
  Gesture gesture_ = Gesture::none;
  PointerState last_;
  // When the button was pressed.
  bool other_button_ = false;  // the middle or right one
  ScreenPoint press_;
  bool clicks_ = false;   // the mouse has not gone far since
  Vec3 centre_{0, 0, 0};  // point of the mesh about which the view turns, or by which it is panned
  LookedAt view_before_;
  Vec3 pivot_before_{0, 0, 0};
  std::string snapped_to_;
};

}  // namespace winslow::gui
