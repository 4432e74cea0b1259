#include "core/mesh/surface_faces.h"

#include <Eigen/Geometry>

#include "core/error.h"

namespace winslow {

std::vector<SurfaceFace> boundary_faces(const Topology& topology) {
  return boundary_faces(topology, topology.markers());
}

std::vector<SurfaceFace> boundary_faces(const Topology& topology, const Markers& markers) {
  if (is_surface(topology)) {
    std::vector<SurfaceFace> elements;
    for (Index e = 0; e < topology.element_count(); ++e)
      elements.push_back({Face(topology.element(e)), e, -1, -1});
    return elements;
  }
  require_kind(topology, MeshKind::volume, "surfaces of elements");
  std::vector<Index> marker_of(at(topology.face_count()), -1);
  for (std::size_t m = 0; m < markers.size(); ++m) {
    for (const Face& face : markers[m].faces) {
      if (const auto f = topology.find_face(face)) marker_of[at(*f)] = static_cast<Index>(m);
    }
  }
  std::vector<SurfaceFace> faces;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] >= 0 && marker_of[at(f)] < 0) continue;
    faces.push_back({face.nodes, face.elements[0], face.elements[1], marker_of[at(f)]});
  }
  return faces;
}

std::vector<SurfaceFace> outer_faces(const Topology& topology,
                                     std::span<const unsigned char> chosen) {
  if (is_surface(topology)) {
    std::vector<SurfaceFace> elements = boundary_faces(topology);
    std::erase_if(elements, [&](const SurfaceFace& face) { return chosen[at(face.element)] == 0; });
    return elements;
  }
  require_kind(topology, MeshKind::volume, "surfaces of elements");
  const auto has = [&](Index e) { return e >= 0 && chosen[at(e)] != 0; };
  std::vector<SurfaceFace> faces;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [nodes, elements] = topology.face(f);
    const bool first = has(elements[0]), second = has(elements[1]);
    if (first == second) continue;
    faces.push_back(first ? SurfaceFace{nodes, elements[0], elements[1]}
                          : SurfaceFace{nodes.reversed(), elements[1], elements[0]});
  }
  return faces;
}

SurfaceEdges surface_edges(std::span<const SurfaceFace> faces) {
  std::vector<std::array<Index, 3>> sides;  // lower node, higher node, face
  sides.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f].nodes;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [low, high] = std::minmax({face[k], face[(k + 1) % face.size()]});
      sides.push_back({low, high, static_cast<Index>(f)});
    }
  }
  std::sort(sides.begin(), sides.end());
  SurfaceEdges edges;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto& [low, high, face] = sides[k];
    edges.faces.values.push_back(face);
    if (k + 1 < sides.size() && sides[k + 1][0] == low && sides[k + 1][1] == high) continue;
    edges.nodes.push_back({low, high});
    edges.faces.end_row();
  }
  return edges;
}

Vec3 area_vector(const SpacePoints& x, const Face& face) {
  if (face.size() == 4) return 0.5 * (x[face[2]] - x[face[0]]).cross(x[face[3]] - x[face[1]]);
  Vec3 sum = (x[face[1]] - x[face[0]]).cross(x[face[2]] - x[face[0]]);
  for (std::size_t k = 3; k < face.size(); ++k)
    sum += (x[face[k - 1]] - x[face[0]]).cross(x[face[k]] - x[face[0]]);
  return 0.5 * sum;
}

Vec3 star_normal(const Topology& topology, const SpacePoints& x, Index node) {
  Vec3 sum = Vec3::Zero();
  for (const Index e : topology.star(node)) sum += area_vector(x, Face(topology.element(e)));
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : sum;
}

Vec3 centre_of(const SpacePoints& x, const Face& face) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : face) sum += x[node];
  return sum / static_cast<double>(face.size());
}

namespace {

/// Whether the face has the nodes of the edge one after the other in this order.
bool runs_along(const Face& face, const std::array<Index, 2>& edge) {
  for (std::size_t k = 0; k < face.size(); ++k)
    if (face[k] == edge[0] && face[(k + 1) % face.size()] == edge[1]) return true;
  return false;
}

}  // namespace

std::vector<unsigned char> feature_edges(const SpacePoints& x, std::span<const SurfaceFace> faces,
                                         const SurfaceEdges& edges, double angle) {
  const double least_cosine = std::cos(radians(angle));
  std::vector<unsigned char> sharp(edges.nodes.size(), 1);
  for (std::size_t k = 0; k < sharp.size(); ++k) {
    const auto around = edges.faces[static_cast<Index>(k)];
    if (around.size() != 2) continue;
    const SurfaceFace& a = faces[at(around[0])];
    const SurfaceFace& b = faces[at(around[1])];
    if (a.marker != b.marker) continue;
    const Vec3 p = area_vector(x, a.nodes), q = area_vector(x, b.nodes);
    // Neighbours that are oriented alike have their common edge in opposite directions.
    const bool one_side =
        runs_along(a.nodes, edges.nodes[k]) != runs_along(b.nodes, edges.nodes[k]);
    const double cosine = (one_side ? 1 : -1) * p.dot(q);
    sharp[k] = cosine < least_cosine * p.norm() * q.norm() ? 1 : 0;
  }
  return sharp;
}

}  // namespace winslow
