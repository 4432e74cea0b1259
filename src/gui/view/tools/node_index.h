#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "gui/base/background.h"
#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/tools/viewport.h"

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

/// Picks nodes with the mouse: the one under it lights up, a click inspects it. Only clicks are the
/// tool's; drags are the viewport's, wherever they begin.
class NodeTool {
 public:
  /// active: clicks near nodes are for the tool. Returns true if the click under way is.
  bool update(const PointerState& pointer, bool active, double scale, const Session& session,
              const View& view, ActionQueue& actions);
  /// The node under the mouse, if one is near enough to be meant. There is a mesh.
  std::optional<Index> node_at(const PointerState& pointer, double scale, const Session& session,
                               const View& view);

 private:
  NodePicker picker_;
  std::optional<Index> hovered_, pressed_;
  ScreenPoint press_;
  bool was_down_ = false;
};

}  // namespace winslow::gui
