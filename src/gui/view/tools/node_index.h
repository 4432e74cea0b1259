#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "gui/base/background.h"

namespace winslow::gui {

/// Nearest node to a point, of those that elements use. Immutable.
class NodeIndex {
 public:
  NodeIndex(const Topology& topology, const Coordinates& coordinates);
  /// None farther away than `radius`; of nodes equally near, the lowest.
  std::optional<Index> nearest(const Vec2& point, double radius) const;

 private:
  std::vector<Index> nodes_;
  BoxTree<2> tree_;  // of nodes_
};

/// Finds the node under the mouse on a mesh that may change at any frame. The tree is built in the
/// background; while it is behind, every node is looked at, which takes a few milliseconds per
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

}  // namespace winslow::gui
