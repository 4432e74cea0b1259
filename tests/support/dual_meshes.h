#pragma once

#include "support/space_meshes.h"

/// Dual meshes in space for tests.
namespace winslow::test {

/// The dual of a mesh of tetrahedra without its boundary: a polyhedron for each interior node,
/// whose corners are the middles of the tetrahedra around it. A face lies between two nodes of an
/// edge, and goes round the tetrahedra at that edge. All of the boundary is the marker "far".
inline MeshData dual_of_interior(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  std::map<Index, Index> corner_of;  // of a tetrahedron
  const auto corner = [&](Index e) {
    const auto [it, fresh] = corner_of.try_emplace(e, data.node_count());
    if (fresh) {
      Vec3 middle(0, 0, 0);
      for (const Index node : topology.element(e)) middle += mesh.coordinates.xyz(node) / 4;
      data.coordinates.push_xyz(middle);
    }
    return it->second;
  };
  const auto has = [&](Index e, Index node) {
    return std::ranges::find(topology.element(e), node) != topology.element(e).end();
  };
  const auto face_between = [&](Index a, Index b) {
    std::vector<Index> left;
    for (const Index e : topology.star(a))
      if (has(e, b)) left.push_back(e);
    std::vector<Index> ring{left.back()};
    left.pop_back();
    while (!left.empty()) {  // the next one shares a face with the last one
      const auto next = std::ranges::find_if(left, [&](Index e) {
        return std::ranges::count_if(topology.element(e),
                                     [&](Index node) { return has(ring.back(), node); }) == 3;
      });
      ring.push_back(*next);
      left.erase(next);
    }
    std::vector<Index> nodes;
    for (const Index e : ring) nodes.push_back(corner(e));
    const Face face{std::span<const Index>(nodes)};
    Vec3 area(0, 0, 0);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      area +=
          data.coordinates.xyz(face[k]).cross(data.coordinates.xyz(face[(k + 1) % nodes.size()]));
    return area.dot(mesh.coordinates.xyz(b) - mesh.coordinates.xyz(a)) > 0 ? face : face.reversed();
  };
  for (const Index node : topology.interior_nodes()) {
    std::vector<Face> faces;
    for (const Index other : topology.neighbours(node)) faces.push_back(face_between(node, other));
    data.add_polyhedron(faces);
  }
  mark_volume(data, [](const Vec3&) { return "far"; });
  return data;
}

}  // namespace winslow::test
