#include "core/mesh/topology.h"

#include <algorithm>

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology_builder.h"

namespace winslow {

Topology::Topology() = default;
Topology::~Topology() = default;

std::shared_ptr<const Topology> Topology::build(const MeshData& data) {
  return TopologyBuilder(data).build();
}

std::optional<Index> Topology::find_marker(std::string_view name) const {
  const auto it = std::find_if(markers_.begin(), markers_.end(),
                               [&](const Marker& marker) { return marker.name == name; });
  if (it == markers_.end()) return std::nullopt;
  return static_cast<Index>(it - markers_.begin());
}

std::vector<Index> Topology::nodes_of_markers(std::span<const std::string> names) const {
  std::vector<Index> nodes;
  for (const std::string& name : names) {
    const auto marker = find_marker(name);
    if (!marker) {
      std::string known;
      for (const Marker& m : markers_) known += (known.empty() ? "" : ", ") + m.name;
      throw UsageError("no marker named '" + name + "'; the mesh has: " + known);
    }
    const auto part = marker_nodes(*marker);
    nodes.insert(nodes.end(), part.begin(), part.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace winslow
