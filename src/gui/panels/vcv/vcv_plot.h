#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/view/tools/vcv_drag.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// The angles (degrees) and edge lengths of a node's VCV, edited or not.
VcvEdit numbers_of(const NodalView& view);

/// Geometry of a picture of a star: position of its node, pixels per unit of length, rotation.
struct VcvFrame {
  ImVec2 min, max, centre;
  double scale = 1;  // double: an edge may exceed the range of float
  double turn = 0;
  ImVec2 pixel(const Vec2& p) const;
  Vec2 point(const ImVec2& p) const;
};

/// Plots a node's physical star beside its VCV, each to scale. The star contains the image of the
/// unit circle under the nodal Jacobian; the edges of the VCV show the weights, negative ones in
/// red. Neighbours have the same numbers in both. The ends of the VCV's edges can be dragged.
class VcvPlot {
 public:
  using Outcome = VcvPlotOutcome;
  /// Draws as wide as the row. highlighted: a neighbour highlighted from elsewhere.
  Outcome draw(const NodalView& view, std::optional<std::size_t> highlighted, const Theme& theme);
  bool dragging() const { return drag_.has_value(); }

 private:
  void drive_drag(const NodalView& view, const VcvFrame& frame, float margin,
                  std::optional<std::size_t> under, Outcome& outcome);

  std::optional<VcvDrag> drag_;
  VcvEdit edit_;         // present state of the drag
  VcvFrame drag_frame_;  // scale and turn at its start
  bool let_go_ = true;   // after Esc the button must be released first
};

}  // namespace winslow::gui
