#include "io/format/groups.h"

#include <set>

namespace winslow::io {

Face BoundaryDetails::face(Index coded) const {
  const Face& side = sides[static_cast<std::size_t>(coded < 0 ? ~coded : coded)];
  return coded < 0 ? side.reversed() : side;
}

bool BoundaryDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (nodes != topology.node_count() || elements != topology.element_count()) return false;
  if (!topology.markers().from_file()) return marker_sides.empty();
  const auto& markers = topology.markers();
  if (markers.size() != marker_sides.size()) return false;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto& own = marker_sides[m];
    const auto same_nodes = [&](Index coded, const Face& other) { return face(coded) == other; };
    if (!std::equal(own.begin(), own.end(), markers[m].faces.begin(), markers[m].faces.end(),
                    same_nodes)) {
      return false;
    }
  }
  return true;
}

std::size_t GroupIndex::add(int tag, std::string name) {
  while (name.empty() || names_.contains(name)) name += "_" + std::to_string(tag);
  names_.insert(name);
  index_[tag] = groups_.size();
  groups_.push_back({std::move(name), tag});
  return groups_.size() - 1;
}

std::size_t GroupIndex::find(int tag) {
  const auto found = index_.find(tag);
  return found != index_.end() ? found->second : add(tag, prefix_ + std::to_string(tag));
}

void add_marker_side(std::size_t marker, Index side, std::size_t offset, BoundaryDetails& details,
                     ParsedMesh& mesh) {
  if (marker >= details.marker_sides.size()) {
    details.marker_sides.resize(marker + 1);
    mesh.where.marker_edges.resize(marker + 1);
  }
  details.marker_sides[marker].push_back(side);
  mesh.where.marker_edges[marker].push_back(offset);
}

void make_markers(const std::vector<Region>& groups, BoundaryDetails& details, ParsedMesh& mesh) {
  details.marker_sides.resize(groups.size());
  mesh.where.marker_edges.resize(groups.size());
  for (std::size_t m = 0; m < groups.size(); ++m) {
    Marker marker{groups[m].name, groups[m].tag, {}};
    marker.faces.reserve(details.marker_sides[m].size());
    for (const Index side : details.marker_sides[m]) marker.faces.push_back(details.face(side));
    mesh.data.markers.push_back(std::move(marker));
  }
}

std::vector<int> usable_tags(std::vector<int> tags, const char* what,
                             std::vector<std::string>& warnings) {
  std::set<int> seen;
  bool usable = true;
  for (const int tag : tags) usable = usable && tag > 0 && seen.insert(tag).second;
  if (usable) return tags;
  for (std::size_t i = 0; i < tags.size(); ++i) tags[i] = static_cast<int>(i) + 1;
  warnings.push_back(std::string("the tags of ") + what +
                     " are not positive and unique: numbered 1, 2, ...");
  return tags;
}

}  // namespace winslow::io
