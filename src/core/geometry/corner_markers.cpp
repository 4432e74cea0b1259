#include <algorithm>

#include "core/geometry/boundary_kinds.h"
#include "core/mesh/place_text.h"

namespace winslow {

CornerMarkers::CornerMarkers(const Topology& topology, std::span<const Index> sliding)
    : topology_(topology), sliding_(sliding.begin(), sliding.end()) {
  const auto& markers = topology.markers();
  for (Index m = 0; m < static_cast<Index>(markers.size()); ++m)
    for (const Index node : markers.nodes(m)) markers_at_[node].push_back(m);
  std::erase_if(markers_at_, [](const auto& entry) { return entry.second.size() < 2; });
}

bool CornerMarkers::meets_sliding(Index node) const {
  const auto found = markers_at_.find(node);
  return found != markers_at_.end() && std::ranges::any_of(found->second, [&](Index m) {
           return std::ranges::find(sliding_, m) != sliding_.end();
         });
}

void CornerMarkers::require_both(const Coordinates& x, const PeriodicPair& pair) const {
  const bool first = meets_sliding(pair.node);
  if (first == meets_sliding(pair.image)) return;
  const Index there = first ? pair.node : pair.image;
  std::string name;
  for (const Index m : markers_at_.at(there))
    if (std::ranges::find(sliding_, m) != sliding_.end()) name = topology_.markers()[at(m)].name;
  refuse_corner(x, there, first ? pair.image : pair.node, name,
                "is on none that does: expected both to slide, or neither");
}

std::optional<Index> CornerMarkers::sliding_at(Index node, const PeriodicPairs& pairs) const {
  const auto found = markers_at_.find(node);
  if (found == markers_at_.end()) return std::nullopt;
  std::optional<Index> only;
  for (const Index m : found->second) {
    const std::string& name = topology_.markers()[at(m)].name;
    if (name == pairs.first || name == pairs.second) continue;
    if (only || std::ranges::find(sliding_, m) == sliding_.end()) return std::nullopt;
    only = m;
  }
  return only;
}

void refuse_corner(const Coordinates& x, Index on_sliding, Index partner, const std::string& marker,
                   const std::string& what) {
  const auto place = [&](Index node) {
    return "node " + std::to_string(node) + " at " +
           (x.dimension() == 2 ? place_text(Vec2(x.xy(node))) : place_text(Vec3(x.xyz(node))));
  };
  throw UsageError(place(on_sliding) + ", at the end of a periodic side, is on \"" + marker +
                   "\", which slides, and its image, " + place(partner) + ", " + what);
}

}  // namespace winslow
