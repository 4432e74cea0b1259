#include <algorithm>

#include "gui/studio/session.h"

/// What refers to nodes, elements and markers follows a command that changes the connectivity.
namespace winslow::gui {

namespace {

std::vector<Index> same_names(const std::vector<Index>& markers, const Topology& before,
                              const Topology& now) {
  std::vector<Index> found;
  for (const Index m : markers) {
    if (m < 0 || static_cast<std::size_t>(m) >= before.markers().size()) continue;
    if (const auto same = now.find_marker(before.markers()[static_cast<std::size_t>(m)].name))
      found.push_back(*same);
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool same_star(Index node, const Topology& before, const Topology& now) {
  if (node >= before.node_count() || node >= now.node_count()) return false;
  return std::ranges::equal(before.neighbours(node), now.neighbours(node));
}

}  // namespace

const std::shared_ptr<const Topology>& Session::topology() const {
  static const std::shared_ptr<const Topology> none;
  if (!document_) return none;
  if (drag_.active()) return drag_state_.mesh.topology;
  return job_.active() ? job_.topology() : document_->topology();
}

std::shared_ptr<const LayerStack> Session::layers() const {
  if (!document_ || topology() != document_->topology()) return nullptr;
  return document_->state().layers;
}

/// Nodes keep their numbers when layers are inserted and removed; elements do not mean the same.
void Session::follow_topology() {
  if (!document_ || !boundary_ || boundary_->topology() == topology()) return;
  const std::shared_ptr<const Topology> before = boundary_->topology();
  const std::shared_ptr<const Topology> now = topology();
  boundary_ = std::make_unique<BoundaryIndex>(now);
  quality_.clear();
  selection_ = same_names(selection_, *before, *now);
  hovered_ = same_names(hovered_, *before, *now);
  shape_edit_.arc.reset();  // counts along the loops of before
  preview_.reset();
  nodes_.keep_if([&](Index node) { return same_star(node, *before, *now); });
  const bool passing = now != document_->topology();
  passing_vcv_ = passing ? std::make_shared<const VirtualControlVolumes>(now) : nullptr;
}

}  // namespace winslow::gui
