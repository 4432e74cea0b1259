#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/render/color_scale.h"
#include "gui/render/space/space_view.h"
#include "gui/view/tools/vcv_drag.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Plots a node's star of tetrahedra beside its VCV, each to scale. The mouse rotates both,
/// together or separately, and drags the points of the VCV over the sphere.
class SpherePlot {
 public:
  using Outcome = VcvPlotOutcome;
  struct Look {
    std::optional<std::size_t> lit;       ///< a neighbour highlighted from elsewhere
    std::optional<std::size_t> lit_face;  ///< a triangle highlighted from elsewhere
    bool large = false;                   ///< one below the other, each as wide as the row
  };
  Outcome draw(const VolumeNodalView& view, const Look& look, const Theme& theme);

  /// True if both rotate together. Linking them gives the VCV the view of the star.
  bool linked() const { return linked_; }
  void link(bool linked);
  /// Sets the view of both.
  void look_from(const ViewDirection& direction);

  bool dragging() const { return drag_.has_value(); }
  /// What stops the dragged point from following the mouse, for the line below the picture.
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
  std::optional<std::size_t> turning_;  // the picture that the mouse rotates
  std::optional<SphereDrag> drag_;
  SpaceCamera drag_camera_;  // at its start
  VcvEdit sent_;
  bool let_go_ = true;  // after Esc the button must be released first
};

}  // namespace winslow::gui
