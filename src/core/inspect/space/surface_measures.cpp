#include "core/inspect/space/surface_measures.h"

#include <Eigen/Geometry>

namespace winslow {

std::vector<Index> element_layers(const Topology& topology, std::span<const Index> nodes) {
  std::vector<Index> layer(at(topology.element_count()), 0);
  std::vector<unsigned char> reached(at(topology.node_count()), 0);
  std::vector<Index> front(nodes.begin(), nodes.end()), next;
  for (const Index node : front) reached[at(node)] = 1;
  for (Index depth = 1; !front.empty(); ++depth) {
    next.clear();
    for (const Index node : front)
      for (const Index e : topology.star(node)) {
        if (layer[at(e)] != 0) continue;
        layer[at(e)] = depth;
        for (const Index other : topology.element(e)) {
          if (reached[at(other)] != 0) continue;
          reached[at(other)] = 1;
          next.push_back(other);
        }
      }
    front.swap(next);
  }
  return layer;
}

namespace {

/// Calls `add` with the corners of each triangle of a face, in the direction of the face.
template <class Add>
void for_triangles(const SpacePoints& x, const Face& face, Add&& add) {
  if (face.size() == 3) return add(x[face[0]], x[face[1]], x[face[2]]);
  const Vec3 centre = centre_of(x, face);
  for (std::size_t k = 0; k < face.size(); ++k)
    add(x[face[k]], x[face[(k + 1) % face.size()]], centre);
}

/// Six times the volume of the tetrahedra of a point with all triangles, positive if these face
/// away from the point.
double sixfold_volume(const SpacePoints& x, std::span<const SurfaceFace> faces, const Vec3& from) {
  double sum = 0;
  for (const SurfaceFace& face : faces)
    for_triangles(x, face.nodes, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      sum += (a - from).dot((b - from).cross(c - from));
    });
  return sum;
}

bool is_closed(std::span<const SurfaceFace> faces) {
  if (faces.empty()) return false;
  const SurfaceEdges edges = surface_edges(faces);
  for (Index k = 0; k < edges.faces.rows(); ++k)
    if (edges.faces[k].size() != 2) return false;
  return true;
}

}  // namespace

double face_area(const SpacePoints& x, const Face& face) {
  double area = 0;
  for_triangles(x, face, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    area += 0.5 * (b - a).cross(c - a).norm();
  });
  return area;
}

double angle_between(const Vec3& normal_a, const Vec3& normal_b) {
  const double across = normal_a.cross(normal_b).norm();
  return std::atan2(across, std::abs(normal_a.dot(normal_b))) * 180 / pi;
}

SurfaceMeasures measure_surface(const SpacePoints& x, std::span<const SurfaceFace> faces) {
  SurfaceMeasures measures;
  measures.faces = static_cast<Index>(faces.size());
  if (faces.empty()) return measures;
  // Relative to a point of the surface, to keep digits far from the origin.
  const Vec3 near = x[faces.front().nodes[0]];
  Vec3 moment(0, 0, 0);
  for (const SurfaceFace& face : faces)
    for_triangles(x, face.nodes, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const Vec3 vector = 0.5 * (b - a).cross(c - a);
      measures.area += vector.norm();
      measures.area_vector += vector;
      moment += vector.norm() * ((a - near) + (b - near) + (c - near)) / 3;
    });
  measures.centroid = near;
  if (measures.area > 0) measures.centroid += moment / measures.area;
  // Faces point out of the mesh: into a body that the mesh surrounds. So the sign does not matter.
  if (is_closed(faces)) measures.volume = std::abs(sixfold_volume(x, faces, near)) / 6;
  return measures;
}

std::vector<SurfaceFace> faces_of_markers(std::span<const SurfaceFace> faces,
                                          std::span<const Index> markers) {
  std::vector<SurfaceFace> chosen;
  std::ranges::copy_if(faces, std::back_inserter(chosen), [&](const SurfaceFace& face) {
    return std::ranges::find(markers, face.marker) != markers.end();
  });
  return chosen;
}

double mesh_volume(const SpacePoints& x, std::span<const SurfaceFace> boundary) {
  std::vector<SurfaceFace> outer;
  outer.reserve(boundary.size());
  std::ranges::copy_if(boundary, std::back_inserter(outer),
                       [](const SurfaceFace& face) { return face.neighbour < 0; });
  if (outer.empty()) return 0;
  return sixfold_volume(x, outer, x[outer.front().nodes[0]]) / 6;
}

}  // namespace winslow
