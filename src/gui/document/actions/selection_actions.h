#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/motion/motion.h"
#include "gui/document/selection/body_anchors.h"
#include "gui/document/selection/shape_edit.h"

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
struct SelectArc {
  std::optional<BoundaryArc> arc;
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
                 action::SetSpacePivot, action::SelectArc, action::PreviewDeformation,
                 action::PreviewMotion, action::SelectNode, action::HoverNode, action::PinNodes>;

}  // namespace winslow::gui
