#include "gui/document/selection/shape_edit.h"

#include <algorithm>
#include <utility>

#include "core/drag/faded_patch.h"

namespace winslow::gui {

bool BoundaryArc::contains(std::size_t position) const {
  if (first <= last) return position >= first && position <= last;
  return position >= first || position <= last;
}

BoundaryArc extended(const BoundaryArc& arc, std::size_t position, std::size_t n) {
  if (arc.contains(position)) return arc;
  const std::size_t forward = (position + n - arc.last) % n;
  const std::size_t backward = (arc.first + n - position) % n;
  return forward <= backward ? BoundaryArc{arc.body, arc.first, position}
                             : BoundaryArc{arc.body, position, arc.last};
}

DragGrip grip_of(const BoundaryArc& arc, double radius, const BoundaryIndex& boundary,
                 const Topology& topology, const Coordinates& rest) {
  const auto& body = boundary.bodies()[static_cast<std::size_t>(arc.body)];
  FadedArc faded = faded_arc(body.nodes, rest, arc.first, arc.last, radius);
  DragGrip grip;
  for (Index m : body.markers)
    grip.markers.push_back(topology.markers()[static_cast<std::size_t>(m)].name);
  grip.nodes = std::move(faded.nodes);
  grip.shares = std::move(faded.shares);
  return grip;
}

bool SurfacePatch::contains(Index node) const { return std::ranges::binary_search(nodes, node); }

DragGrip grip_of(const SurfacePatch& patch, double radius, const Mesh& rest) {
  std::vector<Face> faces;
  DragGrip grip;
  for (const Index m : patch.markers) {
    const Marker& marker = rest.topology->markers()[at(m)];
    grip.markers.push_back(marker.name);
    faces.insert(faces.end(), marker.faces.begin(), marker.faces.end());
  }
  FadedPatch faded = faded_patch(faces, rest.coordinates, patch.nodes, radius);
  grip.nodes = std::move(faded.nodes);
  grip.shares = std::move(faded.shares);
  return grip;
}

}  // namespace winslow::gui
