#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/layers/layer_plan.h"
#include "core/mesh/mesh.h"
#include "support/space_meshes.h"

/// Volume meshes around bodies, for layers on their walls.
namespace winslow::test {

/// Moves nodes of a cube with a cavity of a third of its width so that the cavity becomes a ball
/// (radius 1/6); the outer boundary stays. centre: of both.
inline void round_cavity(MeshData& data, const Vec3& centre) {
  for (Index node = 0; node < data.node_count(); ++node) {
    const Vec3 q = data.coordinates.xyz(node) - centre;
    const double cube = q.cwiseAbs().maxCoeff(), ball = q.norm();
    const double share = std::clamp((0.5 - cube) / (0.5 - 1.0 / 6), 0.0, 1.0);
    data.coordinates.set_xyz(node, centre + (1 - share + share * cube / ball) * q);
  }
}

/// A ball in a cube; markers outer, cavity.
inline Mesh ball_in_box(Index n, Volumes volumes) {
  MeshData data = cube_with_cavity(n, volumes);
  round_cavity(data, Vec3::Constant(0.5));
  return make_mesh(data);
}

/// The upper half of ball_in_box() over a plane of symmetry; n = 6 m. Markers far, floor, body.
inline Mesh half_ball_on_floor(Index n, Volumes volumes) {
  MeshData data = cubes_with_holes(n, volumes, [&](Index i, Index j, Index k) {
    return 3 * i / n == 1 && 3 * j / n == 1 && 6 * k < n;
  });
  round_cavity(data, {0.5, 0.5, 0});
  mark_volume(data, [](const Vec3& p) {
    const bool far = (p.array() > 1 - 1e-9).any() || p.x() < 1e-9 || p.y() < 1e-9;
    return far ? "far" : p.z() < 1e-9 ? "floor" : "body";
  });
  return make_mesh(data);
}

/// Two plates with a gap: the unit cube without a slab, cut through at z from `low` to `high`
/// (numbers of cubes), which does not reach its sides. Markers outer, body.
inline Mesh box_with_slab(Index n, Index low, Index high, Volumes volumes) {
  MeshData data = cubes_with_holes(n, volumes, [&](Index i, Index j, Index k) {
    const auto middle = [&](Index c) { return 4 * c >= n && 4 * c < 3 * n; };
    return middle(i) && middle(j) && k >= low && k < high;
  });
  mark_volume(data, [](const Vec3& p) {
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs();
    return q.maxCoeff() > 0.5 - 1e-9 ? "outer" : "body";
  });
  return make_mesh(data);
}

/// A box over a floor with a square pyramid of the given height, as wide as half the floor. Markers
/// body, far.
inline Mesh box_with_spike(double height) {
  MeshData data = cube(8, Volumes::tetrahedra);
  data.markers.clear();
  for (Index node = 0; node < data.node_count(); ++node) {
    Vec3 p = data.coordinates.xyz(node);
    const double tent =
        height * std::max(0.0, 1 - 4 * std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)));
    p.z() = tent + p.z() * (8 - tent);
    data.coordinates.set_xyz(node, p);
  }
  mark_volume(data, [](const Vec3& p) {
    const bool far =
        p.x() < 1e-9 || p.y() < 1e-9 || p.z() > 8 - 1e-9 || p.x() > 1 - 1e-9 || p.y() > 1 - 1e-9;
    return far ? "far" : "body";
  });
  return make_mesh(data);
}

inline LayerOptions layers_on(const std::string& marker, const LayerSpacing& spacing) {
  LayerOptions options;
  options.walls = {{{marker}, spacing}};
  return options;
}

/// Signed volume of all elements.
inline double total_volume(const Topology& topology, const Coordinates& x) {
  double sum = 0;
  for (Index e = 0; e < topology.element_count(); ++e)
    sum += signed_volume6(x, topology.shape(e), topology.element(e), Vec3(0, 0, 0)) / 6;
  return sum;
}

/// The arrays of a mesh.
inline MeshData arrays_of(const Mesh& mesh) {
  MeshData data;
  data.coordinates = mesh.coordinates;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto corners = mesh.topology->element(e);
    if (mesh.topology->element_type(e) != ElementType::polyhedron) {
      data.add_element(mesh.topology->element_type(e), corners);
      continue;
    }
    std::vector<Face> faces;
    for (const Face& face : mesh.topology->shape(e).faces) faces.push_back(by_nodes(face, corners));
    data.add_polyhedron(corners, faces);
  }
  data.markers = mesh.topology->markers().list();
  return data;
}

/// Number of faces of a marker.
inline std::size_t face_count_of(const Mesh& mesh, const std::string& marker) {
  return mesh.topology->markers()[at(*mesh.topology->markers().find(marker))].faces.size();
}

}  // namespace winslow::test
