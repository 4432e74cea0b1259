#include "gui/document/selection/node_overrides.h"

namespace winslow::gui {

namespace {

bool has(const std::vector<Index>& nodes, Index node) {
  return std::ranges::find(nodes, node) != nodes.end();
}

void put(SlideOptions& slide, Index node, NodeOverride what) {
  std::erase(slide.hold_nodes, node);
  std::erase(slide.smooth_nodes, node);
  if (what == NodeOverride::none) return;
  std::vector<Index>& nodes = what == NodeOverride::hold ? slide.hold_nodes : slide.smooth_nodes;
  nodes.insert(std::ranges::lower_bound(nodes, node), node);
}

}  // namespace

NodeOverride override_of(const SlideOptions& slide, Index node) {
  return has(slide.hold_nodes, node)     ? NodeOverride::hold
         : has(slide.smooth_nodes, node) ? NodeOverride::slide
                                         : NodeOverride::none;
}

void drop_stale_overrides(SlideOptions& slide, const Topology& topology,
                          const std::vector<std::string>& moving) {
  const auto known = [&](Index node) { return node >= 0 && node < topology.node_count(); };
  const auto flags_of = [&](const std::vector<std::string>& names) {
    std::vector<bool> flags(at(topology.node_count()), false);
    for (const std::string& name : names)
      if (const auto marker = topology.markers().find(name))
        for (const Index node : topology.markers().nodes(*marker)) flags[at(node)] = true;
    return flags;
  };
  if (!is_surface(topology) && !slide.smooth_nodes.empty()) {
    const std::vector<bool> slides = flags_of(slide.markers);
    std::erase_if(slide.smooth_nodes,
                  [&](Index node) { return !known(node) || !slides[at(node)]; });
  }
  if (!moving.empty() && !slide.hold_nodes.empty()) {
    const std::vector<bool> moves = flags_of(moving);
    std::erase_if(slide.hold_nodes, [&](Index node) { return !known(node) || moves[at(node)]; });
  }
}

void NodeOverrides::set(SlideOptions& slide, Index node, NodeOverride to, std::uint64_t revision) {
  const NodeOverride before = override_of(slide, node);
  if (before == to) return;
  put(slide, node, to);
  undone_.clear();
  done_.push_back({revision, node, before, to});
}

std::string NodeOverrides::describe(const Change& change) {
  const std::string node = "node " + std::to_string(change.node);
  switch (change.after) {
    case NodeOverride::hold:
      return "Hold " + node;
    case NodeOverride::slide:
      return "Let " + node + " slide";
    case NodeOverride::none:
      break;
  }
  return "Leave " + node + " as found";
}

std::string NodeOverrides::top_of(const std::vector<Change>& changes, std::uint64_t revision) {
  return changes.empty() || changes.back().revision != revision ? std::string()
                                                                : describe(changes.back());
}

std::string NodeOverrides::undoable(std::uint64_t revision) const {
  return top_of(done_, revision);
}

std::string NodeOverrides::redoable(std::uint64_t revision) const {
  return top_of(undone_, revision);
}

/// Moves the last change from one list to the other.
std::string NodeOverrides::step(std::vector<Change>& from, std::vector<Change>& to) {
  to.push_back(from.back());
  from.pop_back();
  return describe(to.back());
}

std::string NodeOverrides::undo(SlideOptions& slide) {
  put(slide, done_.back().node, done_.back().before);
  return step(done_, undone_);
}

std::string NodeOverrides::redo(SlideOptions& slide) {
  put(slide, undone_.back().node, undone_.back().after);
  return step(undone_, done_);
}

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
