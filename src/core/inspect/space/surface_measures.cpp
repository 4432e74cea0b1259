#include "core/inspect/space/surface_measures.h"

#include <Eigen/Geometry>

#include "core/mesh/index_sets.h"

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

constexpr int directions = 200;          // in which points of the hull are found
constexpr double hull_tolerance = 0.01;  // of the mesh's extent

/// The part of each face, as the lowest face of the part.
std::vector<Index> parts_of(std::span<const SurfaceFace> faces) {
  JoinedSets sets(faces.size());
  const SurfaceEdges edges = surface_edges(faces);
  for (Index k = 0; k < edges.faces.rows(); ++k) {
    const auto around = edges.faces[k];
    for (const Index a : around)
      for (const Index b : around)
        if (a < b && faces[at(a)].marker == faces[at(b)].marker) sets.join(a, b);
  }
  std::vector<Index> part(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) part[f] = sets.find(static_cast<Index>(f));
  return part;
}

/// The furthest points of the surface in directions spread evenly over the sphere (a golden-angle
/// spiral).
std::vector<Vec3> hull_points(const SpacePoints& x, std::span<const SurfaceFace> faces) {
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2 * k + 1.0) / directions;
    const double r = std::sqrt(1 - z * z);
    const Vec3 direction(r * std::cos(golden * k), r * std::sin(golden * k), z);
    double furthest = -std::numeric_limits<double>::infinity();
    Vec3 found = Vec3::Zero();
    for (const SurfaceFace& face : faces) {
      const Vec3 p = x[face.nodes[0]];
      if (direction.dot(p) <= furthest) continue;
      furthest = direction.dot(p);
      found = p;
    }
    points.push_back(found);
  }
  return points;
}

/// Whether no point of the hull lies outside the plane of the face.
bool on_hull(const Vec3& centre, const Vec3& area, const std::vector<Vec3>& hull, double slack) {
  const double most = slack * area.norm();
  return std::ranges::none_of(hull, [&](const Vec3& p) { return area.dot(p - centre) > most; });
}

struct Part {
  double area = 0, on_hull = 0;
  Vec3 moment = Vec3::Zero();  // of the centres
  bool encloses() const { return on_hull > 0.5 * area; }
};

}  // namespace

std::vector<unsigned char> enclosing_faces(const Mesh& mesh, std::span<const SurfaceFace> faces) {
  const SpacePoints x(mesh.coordinates);
  const std::vector<Vec3> hull = hull_points(x, faces);
  const double slack = hull_tolerance * space_bounds(mesh).size().norm();
  const std::vector<Index> part_of = parts_of(faces);
  std::vector<Part> parts(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 centre = centre_of(x, faces[f].nodes), area = area_vector(x, faces[f].nodes);
    Part& part = parts[at(part_of[f])];
    part.area += area.norm();
    part.moment += area.norm() * centre;
    if (on_hull(centre, area, hull, slack)) part.on_hull += area.norm();
  }
  double outwards = 0;  // of all bodies
  bool bodies = false;
  std::vector<unsigned char> enclosing(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Part& part = parts[at(part_of[f])];
    enclosing[f] = part.encloses() ? 1 : 0;
    if (part.encloses() || part.area == 0) continue;
    bodies = true;
    if (faces[f].neighbour >= 0) continue;  // inside the mesh: no outward side
    outwards += (centre_of(x, faces[f].nodes) - part.moment / part.area)
                    .dot(area_vector(x, faces[f].nodes));
  }
  if (!bodies || outwards > 0) std::ranges::fill(enclosing, 0);
  return enclosing;
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
