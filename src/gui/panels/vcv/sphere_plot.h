#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/render/color_scale.h"
#include "gui/render/space/space_view.h"
#include "gui/view/tools/vcv_drag.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// A node's star of tetrahedra beside its VCV, each to scale and turned by the mouse, together or
/// one by one. The points of the VCV can be dragged over the sphere.
class SpherePlot {
 public:
  using Outcome = VcvPlotOutcome;
  struct Look {
    std::optional<std::size_t> lit;       ///< a neighbour that is lit up from elsewhere
    std::optional<std::size_t> lit_face;  ///< a triangle that is
    bool large = false;                   ///< one below the other, each across the row
  };
  Outcome draw(const VolumeNodalView& view, const Look& look, const Theme& theme);

  /// Whether both are turned together. Put together, the VCV is seen as the star is.
  bool linked() const { return linked_; }
  void link(bool linked);
  /// Both are seen from here.
  void look_from(const ViewDirection& direction);

  bool dragging() const { return drag_.has_value(); }
  /// Why the point that is dragged does not follow the mouse, for the line below the picture.
  const std::optional<Index>& stopped_by() const;

  /// Colours of both, by their solid angles.
  static ColorScale colors_of(const VolumeNodalView& view);

 private:
  SpaceCamera camera_of(std::size_t which, const ScreenBox& area, const SphereStar& star) const;
  void turn(std::size_t which, const SpaceCamera& camera);
  void drive(const VolumeNodalView& view, const SpaceCamera& camera, const Theme& theme,
             Outcome& outcome);
  bool drag(const Theme& theme);

  bool linked_ = true;
  std::array<ViewDirection, 2> from_{ViewDirection{30, 20, 2}, ViewDirection{30, 20, 2}};
  std::optional<std::size_t> turning_;  // the picture that the mouse turns
  std::optional<SphereDrag> drag_;
  SpaceCamera drag_camera_;  // at its start
  VcvEdit sent_;
  bool let_go_ = true;  // after Esc the button must come up first
};

}  // namespace winslow::gui
