#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/types.h"

namespace winslow::gui {

/// Nodes that the user looks at: one in the inspector, one under the mouse, any number pinned.
class NodeSelection {
 public:
  const std::optional<Index>& inspected() const { return inspected_; }
  const std::optional<Index>& hovered() const { return hovered_; }
  /// Ascending.
  const std::vector<Index>& pinned() const { return pinned_; }
  bool pinned(Index node) const;

  void inspect(std::optional<Index> node) { inspected_ = node; }
  void hover(std::optional<Index> node) { hovered_ = node; }
  void pin(const std::vector<Index>& nodes);
  void unpin(const std::vector<Index>& nodes);
  /// Lets go of all other nodes.
  void keep_if(const std::function<bool(Index)>& keep);

 private:
  std::optional<Index> inspected_, hovered_;
  std::vector<Index> pinned_;
};

}  // namespace winslow::gui
