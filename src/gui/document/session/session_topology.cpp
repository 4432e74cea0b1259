#include <algorithm>
#include <iterator>
#include <utility>

#include "gui/document/session/session.h"

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
  follow_nodes(before, now);
  const bool passing = now != document_->topology();
  passing_vcv_ = passing ? std::make_shared<const VirtualControlVolumes>(now) : nullptr;
}

/// Nodes whose star is another one now are let go of, and taken up again when a mesh of the
/// connectivity before is back: an insertion was cancelled or undone.
void Session::follow_nodes(const std::shared_ptr<const Topology>& before,
                           const std::shared_ptr<const Topology>& now) {
  const auto goes = [&](Index node) { return !same_star(node, *before, *now); };
  LostNodes lost{before, {}, std::nullopt};
  std::ranges::copy_if(nodes_.pinned(), std::back_inserter(lost.pinned), goes);
  if (nodes_.inspected() && goes(*nodes_.inspected())) lost.inspected = nodes_.inspected();
  nodes_.keep_if([&](Index node) { return !goes(node); });
  std::erase_if(lost_nodes_, [&](const LostNodes& earlier) {
    const auto topology = earlier.topology.lock();
    if (topology == now) {
      nodes_.pin(earlier.pinned);
      if (!nodes_.inspected() && earlier.inspected) nodes_.inspect(earlier.inspected);
    }
    return !topology || topology == now || topology == before;
  });
  if (!lost.pinned.empty() || lost.inspected) lost_nodes_.push_back(std::move(lost));
}

}  // namespace winslow::gui
