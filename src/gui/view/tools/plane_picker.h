#pragma once

#include "gui/document/selection/boundary_index.h"
#include "gui/view/tools/mesh_picker.h"
#include "gui/view/tools/node_index.h"

namespace winslow::gui {

/// Picks in meshes of the plane: bodies, nodes of the boundary while shapes are edited, nodes.
class PlanePicker : public MeshPicker {
 public:
  bool takes() const override { return hit_ || corner_; }
  std::optional<Vec3> point(const PointerFrame& frame) const override;
  Vec3 middle(const PointerFrame& frame) const override;
  std::optional<Vec3> take(const PointerFrame& frame) override;
  void click(const PointerFrame& frame) const override;
  bool inspect(const PointerFrame& frame) const override;
  std::optional<RulerPoint> ruler_point(const PointerFrame& frame) override;
  PickedPlace place_at(const ScreenPoint& at, const PointerFrame& frame) override;

  /// Where the mouse puts the pivot; with Control it snaps to what has a name, and to nodes.
  struct PivotPlacing {
    Vec2 at{0, 0};
    std::string snapped_to;  ///< empty: nothing
  };
  static PivotPlacing place_pivot(const PointerFrame& frame);

 private:
  void find(const PointerFrame& frame, bool handled) override;
  void forget() override;
  std::optional<Index> node_near(const ScreenPoint& at, const PointerFrame& frame);
  void hold(bool extend, const PointerFrame& frame) const;

  NodePicker nodes_;
  std::optional<BoundaryIndex::Hit> hit_;
  std::optional<BoundaryIndex::NodeHit> corner_;
};

}  // namespace winslow::gui
