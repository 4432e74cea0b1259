#pragma once

#include "gui/document/actions/actions.h"
#include "gui/document/selection/pivot.h"
#include "gui/settings/view_state.h"
#include "gui/view/tools/pointer.h"
#include "gui/view/tools/ruler.h"

namespace winslow::gui {

/// Finds what lies under the mouse in the mesh on screen, and interprets clicks and drags there:
/// one subclass for plane meshes, one for meshes in space.
///
///     picker.look(frame, false);
///     if (const auto point = picker.grab(frame)) mover.grab(*point, press, frame);
class MeshPicker {
 public:
  virtual ~MeshPicker() = default;

  /// Finds what lies under the mouse, and reports changes of the markers and the node there as
  /// actions. handled: the mouse is over a handle, which has priority.
  void look(const PointerFrame& frame, bool handled) {
    found_ = {};
    frame.pointer.over ? find(frame, handled) : forget();
    if (found_.node != told_node_) frame.actions.emplace_back(action::HoverNode{found_.node});
    told_node_ = found_.node;
    if (found_.markers != told_markers_)
      frame.actions.emplace_back(action::HoverMarkers{found_.markers});
    told_markers_ = found_.markers;
  }
  /// Makes the next look() search again: mesh or view may have changed under a resting mouse.
  virtual void look_again() {}

  // What lies under the mouse, as of the last look().
  /// Markers that a click selects.
  const std::vector<Index>& markers() const { return found_.markers; }
  /// Nodes of the boundary that a click holds while shapes are edited: one, or those of a face.
  const std::vector<Index>& held() const { return found_.held; }
  /// What a click sets the pivot to.
  const std::optional<PivotSource>& pivot_source() const { return found_.pivot_source; }
  /// The place of the mesh under the mouse; only in space.
  const std::optional<SeenPlace>& seen() const { return seen_; }
  /// True if a drag can grab what lies under the mouse.
  virtual bool takes() const { return held().size() == 1; }

  /// The point of the mesh under the mouse; none: nothing lies there.
  virtual std::optional<Vec3> point(const PointerFrame& frame) const = 0;
  /// The point about which the view turns if nothing lies under the mouse.
  virtual Vec3 middle(const PointerFrame& frame) const = 0;

  /// Begins a drag with the left button of a body, or of nodes of the boundary; selects them unless
  /// they are selected. Returns a point of what is dragged; none: there is nothing to drag.
  virtual std::optional<Vec3> grab(const PointerFrame& frame) = 0;
  virtual void click(const PointerFrame& frame) const = 0;
  /// Shows the node under the mouse in the tab VCV. False if clicks do not pick nodes, or none is
  /// there.
  virtual bool inspect(const PointerFrame& frame) const = 0;
  /// Where a click puts a point of the ruler; none: nowhere.
  virtual std::optional<RulerPoint> ruler_point(const PointerFrame& frame) = 0;
  /// The item to which the menu of a right click applies.
  virtual PickedPlace place_at(const ScreenPoint& at, const PointerFrame& frame) = 0;

 protected:
  struct Found {
    std::vector<Index> markers, held;
    std::optional<PivotSource> pivot_source;
    std::optional<Index> node;  ///< that a click inspects
  };
  /// Finds what lies under the mouse. found_ is empty when it is called.
  virtual void find(const PointerFrame& frame, bool handled) = 0;
  /// Called when the mouse is elsewhere.
  virtual void forget() = 0;

  Found found_;
  std::optional<SeenPlace> seen_;

 private:
  std::vector<Index> told_markers_;
  std::optional<Index> told_node_;
};

}  // namespace winslow::gui
