#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "gui/base/background.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/view/tools/mesh_picker.h"

namespace winslow::gui {

/// Finds the node nearest to a point, of the nodes that elements use. Immutable.
class NodeIndex {
 public:
  NodeIndex(const Topology& topology, const Coordinates& coordinates);
  /// The nearest node within `radius`; of nodes equally near, the lowest. None if none is so near.
  std::optional<Index> nearest(const Vec2& point, double radius) const;

 private:
  std::vector<Index> nodes_;
  BoxTree<2> tree_;  // of nodes_
};

/// Finds the node under the mouse on a mesh that may change at any frame. The tree is built in the
/// background; until it is up to date, every node is searched, which takes a few milliseconds per
/// million.
class NodePicker {
 public:
  /// Begins to index a mesh if it is not the one indexed. shape: identifies it.
  void prepare(std::uint64_t shape, const std::shared_ptr<const Topology>& topology,
               const Coordinates& coordinates);
  std::optional<Index> pick(std::uint64_t shape, const Topology& topology,
                            const Coordinates& coordinates, const Vec2& point, double radius);
  bool busy() const { return worker_.busy(); }

 private:
  struct Built {
    std::uint64_t shape = 0;
    std::shared_ptr<const NodeIndex> index;
  };
  void collect();

  Background<Built> worker_;
  Built built_;
};

/// Picks in meshes of the plane: bodies, nodes of the boundary while shapes are edited, nodes.
class PlanePicker : public MeshPicker {
 public:
  bool takes() const override { return hit_ || corner_; }
  std::optional<Vec3> point(const PointerFrame& frame) const override;
  Vec3 middle(const PointerFrame& frame) const override;
  std::optional<Vec3> grab(const PointerFrame& frame) override;
  void click(const PointerFrame& frame) const override;
  bool inspect(const PointerFrame& frame) const override;
  std::optional<RulerPoint> ruler_point(const PointerFrame& frame) override;
  PickedPlace place_at(const ScreenPoint& at, const PointerFrame& frame) override;

  /// Where the mouse puts the pivot; with Control it snaps to named points and to nodes.
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
