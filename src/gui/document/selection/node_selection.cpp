#include "gui/document/selection/node_selection.h"

#include <algorithm>

namespace winslow::gui {

bool NodeSelection::pinned(Index node) const {
  return std::binary_search(pinned_.begin(), pinned_.end(), node);
}

void NodeSelection::pin(const std::vector<Index>& nodes) {
  pinned_.insert(pinned_.end(), nodes.begin(), nodes.end());
  std::sort(pinned_.begin(), pinned_.end());
  pinned_.erase(std::unique(pinned_.begin(), pinned_.end()), pinned_.end());
}

void NodeSelection::unpin(const std::vector<Index>& nodes) {
  std::erase_if(pinned_, [&](Index node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  });
}

void NodeSelection::keep_if(const std::function<bool(Index)>& keep) {
  if (inspected_ && !keep(*inspected_)) inspected_.reset();
  if (hovered_ && !keep(*hovered_)) hovered_.reset();
  std::erase_if(pinned_, [&](Index node) { return !keep(node); });
}

}  // namespace winslow::gui
