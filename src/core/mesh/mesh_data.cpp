#include "core/mesh/mesh_data.h"

#include "core/error.h"

namespace winslow {

std::optional<Index> Markers::find(std::string_view name) const {
  const auto it = std::find_if(list_.begin(), list_.end(),
                               [&](const Marker& marker) { return marker.name == name; });
  if (it == list_.end()) return std::nullopt;
  return static_cast<Index>(it - list_.begin());
}

std::vector<Index> Markers::nodes_of(std::span<const std::string> names) const {
  std::vector<Index> nodes;
  for (const std::string& name : names) {
    const auto marker = find(name);
    if (!marker) {
      std::string known;
      for (const Marker& m : list_) known += (known.empty() ? "" : ", ") + m.name;
      throw UsageError("no marker named '" + name + "'; the mesh has: " + known);
    }
    const auto part = nodes_[*marker];
    nodes.insert(nodes.end(), part.begin(), part.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace winslow
