#include "core/quality/walls.h"

#include <unordered_map>

namespace winslow {

namespace {

/// With the elements on the left, loops around them turn left and loops around bodies right.
bool bounds_a_body(const PlanePoints& x, const std::vector<Index>& loop) {
  const Vec2 origin = x[loop.front()];  // far from the true one, areas would cancel
  double area2 = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 a = x[loop[k]] - origin, b = x[loop[(k + 1) % loop.size()]] - origin;
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  return area2 < 0;
}

}  // namespace

std::vector<Wall> find_walls(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "walls");
  const PlanePoints x(mesh.coordinates);
  std::vector<Wall> walls;
  std::unordered_map<Index, std::size_t> wall_of_node;
  for (const auto& loop : topology.boundary_loops()) {
    if (!bounds_a_body(x, loop)) continue;
    for (const Index node : loop) wall_of_node[node] = walls.size();
    walls.push_back({loop, {}});
  }
  for (const Marker& marker : topology.markers()) {
    for (const Face& face : marker.faces) {
      const auto [a, b] = face.edge();
      const auto from = wall_of_node.find(a), to = wall_of_node.find(b);
      if (from == wall_of_node.end() || to == wall_of_node.end() || from->second != to->second)
        continue;
      auto& names = walls[from->second].markers;
      if (names.empty() || names.back() != marker.name) names.push_back(marker.name);
    }
  }
  return walls;
}

}  // namespace winslow
