#include "core/quality/surface_distance.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/inspect/element_field.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

/// The nearest point of a triangle, by the regions around it (Ericson, Real-Time Collision
/// Detection, 5.1.5).
Vec3 nearest_on(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

/// By going through all triangles of a mesh of triangles.
double brute_force(const Vec3& p, const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  double least = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto t = mesh.topology->element(e);
    least = std::min(least, (p - nearest_on(p, x[t[0]], x[t[1]], x[t[2]])).norm());
  }
  return least;
}

/// Its nodes shaken by up to `by` in each direction.
Mesh shaken(Mesh mesh, double by, std::uint64_t seed) {
  Random random(seed);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    Vec3 shift;
    for (double& s : shift) s = by * random.uniform(-1, 1);
    mesh.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + shift);
  }
  return mesh;
}

}  // namespace

TEST_CASE("distances of nodes and elements are those of a search through all triangles") {
  const Mesh given = make_mesh(octasphere(5));
  for (const double by : {0.02, 0.4}) {
    const Mesh mesh = shaken(given, by, 11);
    const SpacePoints x(mesh.coordinates);
    const SurfaceDistance distance(given);
    const std::vector<double> nodes = node_distances(mesh, distance);
    for (Index i = 0; i < mesh.coordinates.size(); ++i)
      CHECK(nodes[at(i)] == doctest::Approx(brute_force(x[i], given)).epsilon(1e-12));
    const std::vector<double> elements = element_distances(mesh, distance);
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const auto t = mesh.topology->element(e);
      double largest = brute_force((x[t[0]] + x[t[1]] + x[t[2]]) / 3, given);
      for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max(largest, brute_force(x[t[k]], given));
        largest = std::max(largest, brute_force(0.5 * (x[t[k]] + x[t[(k + 1) % 3]]), given));
      }
      CHECK(elements[at(e)] == doctest::Approx(largest).epsilon(1e-12));
      CHECK(element_distance(mesh, e, distance) == elements[at(e)]);
    }
    // The report has the largest of them.
    const SurfaceChange change = compare_surfaces(given, mesh);
    CHECK(change.from_after == *std::ranges::max_element(elements));
    CHECK(element_distances(mesh, distance, 1) == elements);
    CHECK(surface_values(mesh, SurfaceField::deviation, {}, distance) == elements);
  }
}

TEST_CASE("a mesh of quadrilaterals lies on itself, and one beside it is as far away as it is") {
  const auto wavy = [](const Vec2& p) { return on_torus(p, 2, 0.7); };
  const Mesh given = make_mesh(torus_grid(14, 8, Cells::mixed, wavy));
  const SurfaceDistance distance(given);
  for (const double d : element_distances(given, distance)) CHECK(d < 1e-14);
  Mesh aside = given;
  for (Index i = 0; i < aside.coordinates.size(); ++i)
    aside.coordinates.set_xyz(i, given.coordinates.xyz(i) + Vec3(0, 0, 5));
  // Its top lies four tube radii and more above: 5 over the other's top.
  const std::vector<double> far = element_distances(aside, distance);
  CHECK(*std::ranges::max_element(far) == doctest::Approx(5).epsilon(1e-3));
  CHECK_THROWS_AS(SurfaceDistance(make_mesh(square(2, Cells::quads))), UsageError);
}

TEST_CASE("fields of a surface mesh are the metrics and the deviation") {
  const std::vector<ElementField>& fields = all_element_fields(MeshKind::surface);
  CHECK(fields.size() == all_metrics(2).size() + 1);
  CHECK(fields.back() == ElementField(SurfaceField::deviation));
  CHECK(parse_field("deviation", MeshKind::surface).surface() != nullptr);
  CHECK_THROWS_AS(parse_field("deviation"), UsageError);
  CHECK_THROWS_AS(parse_field("kappa", MeshKind::surface), UsageError);
  // Fields of other meshes have no values here.
  const Mesh mesh = make_mesh(octasphere(2));
  const SurfaceDistance distance(mesh);
  CHECK(surface_values(mesh, NodalField::kappa, {}, distance).empty());
  const auto sines = surface_values(mesh, Metric::normalized_jacobian, {}, distance);
  CHECK(sines == element_values(mesh, Metric::normalized_jacobian));
}

}  // namespace winslow::test
