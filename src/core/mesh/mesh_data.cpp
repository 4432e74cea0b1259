#include "core/mesh/mesh_data.h"

#include "core/error.h"

namespace winslow {

void MeshData::add_polyhedron(std::span<const Face> of_element) {
  std::vector<Index> corners;
  for (const Face& face : of_element)
    for (const Index node : face) corners.push_back(node);
  // Each once, in the order in which they come first.
  std::vector<std::pair<Index, std::size_t>> first;
  for (std::size_t k = 0; k < corners.size(); ++k) first.emplace_back(corners[k], k);
  std::ranges::sort(first);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < first.size(); ++k)
    if (k == 0 || first[k].first != first[k - 1].first) places.push_back(first[k].second);
  std::ranges::sort(places);
  std::vector<Index> own;
  for (const std::size_t k : places) own.push_back(corners[k]);
  add_polyhedron(own, of_element);
}

void MeshData::add_polyhedron(std::span<const Index> corners, std::span<const Face> of_element) {
  if (face_offsets.empty()) face_offsets.assign(element_offsets.size(), 0);
  types.push_back(ElementType::polyhedron);
  element_nodes.insert(element_nodes.end(), corners.begin(), corners.end());
  element_offsets.push_back(index_count(element_nodes.size(), "corners of elements"));
  faces.insert(faces.end(), of_element.begin(), of_element.end());
  face_offsets.push_back(index_count(faces.size(), "faces of polyhedra"));
}

const MeshWords& words_of(MeshKind kind) {
  static constexpr std::array<MeshWords, 3> words{{
      {"plane mesh", "edge", "an edge", "joins", "surface", "loop_"},
      {"surface mesh", "edge", "an edge", "joins", "surface", "loop_"},
      {"volume mesh", "face", "a face", "has", "volume", "boundary_"},
  }};
  return words[static_cast<std::size_t>(kind)];
}

void Markers::add_nodes_of(const Marker& marker) {
  std::vector<Index> nodes;
  for (const Face& face : marker.faces) nodes.insert(nodes.end(), face.begin(), face.end());
  sort_unique(nodes);
  nodes_.values.insert(nodes_.values.end(), nodes.begin(), nodes.end());
  nodes_.end_row();
}

Markers Markers::with(std::span<const Marker> more) const {
  Markers all = *this;
  for (const Marker& marker : more) {
    all.list_.push_back(marker);
    all.add_nodes_of(marker);
  }
  return all;
}

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
    if (!marker)
      throw UsageError("no marker named '" + name +
                       "'; the mesh has: " + listed(list_, [](const Marker& m) { return m.name; }));
    const auto part = nodes_[*marker];
    nodes.insert(nodes.end(), part.begin(), part.end());
  }
  sort_unique(nodes);
  return nodes;
}

}  // namespace winslow
