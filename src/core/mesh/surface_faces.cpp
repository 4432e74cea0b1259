#include "core/mesh/surface_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"

namespace winslow {

namespace {

void require_volume(const Topology& topology) {
  if (topology.cell_dimension() != 3)
    throw UsageError("surfaces of elements: only for a volume mesh, and this is a " +
                     std::string(mesh_kind(topology)));
}

}  // namespace

std::vector<SurfaceFace> boundary_faces(const Topology& topology) {
  if (topology.cell_dimension() == 2 && topology.space_dimension() == 3) {
    std::vector<SurfaceFace> elements;
    for (Index e = 0; e < topology.element_count(); ++e)
      elements.push_back({Face(topology.element(e)), e, -1, -1});
    return elements;
  }
  require_volume(topology);
  std::vector<Index> marker_of(at(topology.face_count()), -1);
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    for (const Face& face : topology.markers()[m].faces) {
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
  require_volume(topology);
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
  return 0.5 * (x[face[1]] - x[face[0]]).cross(x[face[2]] - x[face[0]]);
}

Vec3 centre_of(const SpacePoints& x, const Face& face) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : face) sum += x[node];
  return sum / static_cast<double>(face.size());
}

namespace {

/// A face has its corners a, b in this order.
bool runs_along(const Face& face, const std::array<Index, 2>& edge) {
  for (std::size_t k = 0; k < face.size(); ++k)
    if (face[k] == edge[0] && face[(k + 1) % face.size()] == edge[1]) return true;
  return false;
}

/// 1 if two faces are seen from one side, -1 if one is seen from behind: those of one side run
/// along their edge in opposite directions.
double sides(const SurfaceFace& a, const SurfaceFace& b, const std::array<Index, 2>& edge) {
  return runs_along(a.nodes, edge) != runs_along(b.nodes, edge) ? 1 : -1;
}

/// A triangle less than a tenth as high as it is long. area: its area vector.
bool is_sliver(const SpacePoints& x, const Face& face, const Vec3& area) {
  if (face.size() != 3) return false;
  double longest2 = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest2 = std::max(longest2, (x[face[(k + 1) % 3]] - x[face[k]]).squaredNorm());
  constexpr double flat = 0.1;
  return 2 * area.norm() < flat * longest2;
}

/// Where slivers face by chance.
class Slivers {
 public:
  Slivers(const SpacePoints& x, std::span<const SurfaceFace> faces, const SurfaceEdges& edges,
          double least_cosine, std::span<const Vec3> areas)
      : faces_(faces), edges_(edges), least_cosine_(least_cosine), areas_(areas) {
    edges_of_.resize(faces.size());
    for (std::size_t k = 0; k < edges.nodes.size(); ++k) {
      const auto [a, b] = edges.nodes[k];
      lengths_.push_back((x[b] - x[a]).norm());
      for (const Index f : edges.faces[static_cast<Index>(k)])
        edges_of_[at(f)].push_back(static_cast<Index>(k));
    }
  }

  /// The normal that a sliver has by its neighbours; none if its own is not chance.
  std::optional<Vec3> normal_around(std::size_t f) const {
    std::vector<Index> edges = edges_of_[f];
    std::ranges::sort(edges, std::greater<>(), [&](Index k) { return lengths_[at(k)]; });
    const auto first = beyond(f, edges[0]), second = beyond(f, edges[1]);
    if (!first || !second || turns(*first, *second)) return std::nullopt;
    if (!turns(areas_[f], *first) || !turns(areas_[f], *second)) return std::nullopt;
    return first->normalized() + second->normalized();
  }

 private:
  /// The area vector of the face beyond an edge, seen from this face's side.
  std::optional<Vec3> beyond(std::size_t f, Index edge) const {
    const auto around = edges_.faces[edge];
    if (around.size() != 2) return std::nullopt;
    const std::size_t other = at(around[0]) == f ? at(around[1]) : at(around[0]);
    if (faces_[other].marker != faces_[f].marker || areas_[other].norm() == 0) return std::nullopt;
    return sides(faces_[f], faces_[other], edges_.nodes[at(edge)]) * areas_[other];
  }
  bool turns(const Vec3& a, const Vec3& b) const {
    return a.dot(b) < least_cosine_ * a.norm() * b.norm();
  }

  std::span<const SurfaceFace> faces_;
  const SurfaceEdges& edges_;
  double least_cosine_;
  std::span<const Vec3> areas_;
  std::vector<double> lengths_;               // #edges
  std::vector<std::vector<Index>> edges_of_;  // #faces
};

}  // namespace

std::vector<Vec3> face_normals(const SpacePoints& x, std::span<const SurfaceFace> faces,
                               const SurfaceEdges& edges, double angle) {
  std::vector<Vec3> areas;
  areas.reserve(faces.size());
  for (const SurfaceFace& face : faces) areas.push_back(area_vector(x, face.nodes));
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (is_sliver(x, faces[f].nodes, areas[f])) found.push_back(f);
  if (found.empty()) return areas;
  std::vector<Vec3> normals = areas;
  const Slivers slivers(x, faces, edges, std::cos(radians(angle)), areas);
  for (const std::size_t f : found)
    if (const auto around = slivers.normal_around(f)) normals[f] = *around;
  return normals;
}

std::vector<unsigned char> feature_edges(const SpacePoints& x, std::span<const SurfaceFace> faces,
                                         const SurfaceEdges& edges, double angle) {
  const double least_cosine = std::cos(radians(angle));
  const std::vector<Vec3> normals = face_normals(x, faces, edges, angle);
  std::vector<unsigned char> sharp(edges.nodes.size(), 1);
  for (std::size_t k = 0; k < sharp.size(); ++k) {
    const auto around = edges.faces[static_cast<Index>(k)];
    if (around.size() != 2) continue;
    const SurfaceFace& a = faces[at(around[0])];
    const SurfaceFace& b = faces[at(around[1])];
    if (a.marker != b.marker) continue;
    const Vec3 &p = normals[at(around[0])], &q = normals[at(around[1])];
    const double cosine = sides(a, b, edges.nodes[k]) * p.dot(q);
    sharp[k] = cosine < least_cosine * p.norm() * q.norm() ? 1 : 0;
  }
  return sharp;
}

}  // namespace winslow
