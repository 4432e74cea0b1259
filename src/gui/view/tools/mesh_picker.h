#pragma once

#include "gui/document/actions/actions.h"
#include "gui/document/selection/pivot.h"
#include "gui/settings/view_state.h"
#include "gui/view/tools/pointer.h"
#include "gui/view/tools/ruler.h"

namespace winslow::gui {

/// What lies under the mouse in the mesh that is shown, and what clicks and drags of it mean: one
/// kind of picker for meshes of the plane, one for those of space.
///
///     picker.look(frame, false);
///     if (const auto point = picker.grab(frame)) mover.grab(*point, press, frame);
class MeshPicker {
 public:
  virtual ~MeshPicker() = default;

  /// Looks at what lies under the mouse, and says which markers and node that are. handled: a
  /// handle is there, which comes first.
  void look(const PointerFrame& frame, bool handled) {
    found_ = {};
    frame.pointer.over ? find(frame, handled) : forget();
    if (found_.node != told_node_) frame.actions.emplace_back(action::HoverNode{found_.node});
    told_node_ = found_.node;
    if (found_.markers != told_markers_)
      frame.actions.emplace_back(action::HoverMarkers{found_.markers});
    told_markers_ = found_.markers;
  }
  /// The mesh or the view may be another, though the mouse is where it was.
  virtual void look_again() {}

  // What lies under the mouse, as of the last look().
  /// Markers that a click selects.
  const std::vector<Index>& markers() const { return found_.markers; }
  /// Nodes of the boundary that a click holds while shapes are edited: one, or those of a face.
  const std::vector<Index>& held() const { return found_.held; }
  /// What a click takes the pivot from.
  const std::optional<PivotSource>& pivot_source() const { return found_.pivot_source; }
  /// In space.
  const std::optional<SeenPlace>& seen() const { return seen_; }
  /// A drag takes hold of it.
  virtual bool takes() const { return held().size() == 1; }

  /// The point of the mesh there; none: nothing is.
  virtual std::optional<Vec3> point(const PointerFrame& frame) const = 0;
  /// What the view turns about where nothing lies under the mouse.
  virtual Vec3 middle(const PointerFrame& frame) const = 0;

  /// A drag begins here with the left button. A point of what it takes hold of: a body, or nodes of
  /// the boundary, which are selected then; none: nothing.
  virtual std::optional<Vec3> grab(const PointerFrame& frame) = 0;
  virtual void click(const PointerFrame& frame) const = 0;
  /// Shows the node under the mouse in the tab VCV, if that is what clicks are for. False if not.
  virtual bool inspect(const PointerFrame& frame) const = 0;
  /// Where a click puts a point of the ruler; none: nowhere.
  virtual std::optional<RulerPoint> ruler_point(const PointerFrame& frame) = 0;
  /// What the menu of a right click is about.
  virtual PickedPlace place_at(const ScreenPoint& at, const PointerFrame& frame) = 0;

 protected:
  struct Found {
    std::vector<Index> markers, held;
    std::optional<PivotSource> pivot_source;
    std::optional<Index> node;  ///< that a click inspects
  };
  /// Looks at what lies under the mouse; what was found before is forgotten.
  virtual void find(const PointerFrame& frame, bool handled) = 0;
  /// The mouse is elsewhere.
  virtual void forget() = 0;

  Found found_;
  std::optional<SeenPlace> seen_;

 private:
  std::vector<Index> told_markers_;
  std::optional<Index> told_node_;
};

}  // namespace winslow::gui
