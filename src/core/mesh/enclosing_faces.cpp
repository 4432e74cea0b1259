#include "core/mesh/enclosing_faces.h"

#include "core/mesh/index_sets.h"

namespace winslow {

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

}  // namespace winslow
