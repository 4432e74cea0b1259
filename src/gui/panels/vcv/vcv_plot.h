#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/view/tools/vcv_drag.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// The angles (degrees) and edge lengths of a node's VCV, edited or not.
VcvEdit numbers_of(const NodalView& view);

/// A picture of a star: where its node is, pixels per unit of length, how far it is turned.
struct VcvFrame {
  ImVec2 min, max, centre;
  double scale = 1;  // an edge may be longer than a float can say
  double turn = 0;
  ImVec2 pixel(const Vec2& p) const;
  Vec2 point(const ImVec2& p) const;
};

/// A node's physical star beside its VCV, each to scale. In the star, the image of the unit circle
/// under the nodal Jacobian; on the edges of the VCV the weights, negative ones in red. Neighbours
/// have the same numbers in both. The ends of the VCV's edges can be dragged.
class VcvPlot {
 public:
  using Outcome = VcvPlotOutcome;
  /// Across the row. highlighted: a neighbour lit up from elsewhere.
  Outcome draw(const NodalView& view, std::optional<std::size_t> highlighted, const Theme& theme);
  bool dragging() const { return drag_.has_value(); }

 private:
  void drive_drag(const NodalView& view, const VcvFrame& frame, float margin,
                  std::optional<std::size_t> under, Outcome& outcome);

  std::optional<VcvDrag> drag_;
  VcvEdit edit_;         // where the drag has got to
  VcvFrame drag_frame_;  // scale and turn at its start
  bool let_go_ = true;   // after Esc the button must come up first
};

}  // namespace winslow::gui
