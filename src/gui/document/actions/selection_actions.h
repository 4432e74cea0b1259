#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/motion/motion.h"
#include "gui/document/selection/body_anchors.h"
#include "gui/document/selection/shape_edit.h"
#include "gui/document/selection/space_pivot.h"

/// What is selected, hovered, pinned and inspected. Carried out by Selection.
namespace winslow::gui::action {

struct SelectMarkers {
  std::vector<Index> markers;
  bool toggle = false;  ///< true: add or remove; false: select these alone
};
struct HoverMarkers {
  std::vector<Index> markers;
};
struct SetPivot {
  std::optional<Vec2> pivot;  ///< none: at the place named
  PivotPlace place = PivotPlace::centre;
};
/// The same of a volume mesh; none: at the centre of what is selected.
struct SetSpacePivot {
  std::optional<Vec3> pivot;
};
/// The axis about which a selection of a volume mesh turns.
struct SetSpaceAxis {
  Vec3 axis{0, 0, 1};
};
/// Pivot and axis from what was picked in a volume mesh.
struct TakePivot {
  PivotSource source;
};
/// The next click in a volume mesh picks a pivot from a node, an edge, a face, or from two nodes,
/// of which `first` is taken; none: no more.
struct PickPivot {
  std::optional<PivotFrom> from;
  std::optional<Index> first = {};
};
struct SelectArc {
  std::optional<BoundaryArc> arc;
};
/// Nodes of a volume mesh that are held to be dragged; none: no more.
struct SelectPatch {
  std::optional<SurfacePatch> patch;
};
/// A deformation of the selected bodies, shown as an outline only; none: no more.
struct PreviewDeformation {
  std::optional<SineDeformation> shape;
};
/// A rigid motion of the selected bodies, shown as an outline only; none: no more.
struct PreviewMotion {
  std::optional<RigidMotionRequest> motion;
};
/// Selects the node of the inspector; none: no node.
struct SelectNode {
  std::optional<Index> node;
};
struct HoverNode {
  std::optional<Index> node;
};
struct PinNodes {
  std::vector<Index> nodes;
  bool pinned = true;  ///< false: take the pins away
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using SelectionAction =
    std::variant<action::SelectMarkers, action::HoverMarkers, action::SetPivot,
                 action::SetSpacePivot, action::SetSpaceAxis, action::TakePivot, action::PickPivot,
                 action::SelectArc, action::SelectPatch, action::PreviewDeformation,
                 action::PreviewMotion, action::SelectNode, action::HoverNode, action::PinNodes>;

}  // namespace winslow::gui
