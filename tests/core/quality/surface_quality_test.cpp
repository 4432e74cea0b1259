#include <doctest/doctest.h>

#include <cmath>

#include "core/error.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "core/quality/validity.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 2).normalized()).toRotationMatrix();

Vec3 embedded(const Vec2& p) { return turn * Vec3(p.x(), p.y(), 0) + Vec3(1, 2, 3); }

}  // namespace

TEST_CASE("surface quality: that of a plane mesh, wherever it lies in space") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    Random random(1);
    MeshData data = square_with_hole(10, cells);
    Mesh plane = make_mesh(data);
    for (const bool tangled : {false, true}) {
      tangled ? tangle(plane, random) : perturb(plane, random, 0.4);
      Mesh mesh{make_mesh(lifted(data, embedded)).topology,
                Coordinates(3, plane.coordinates.size())};
      for (Index i = 0; i < plane.coordinates.size(); ++i)
        mesh.coordinates.set_xyz(i, embedded(plane.coordinates.xy(i)));
      QualityOptions options;
      options.normals.assign(at(mesh.topology->element_count()), turn.col(2));
      const QualityReport flat = measure_quality(plane), space = measure_quality(mesh, options);
      CHECK(space.inverted == flat.inverted);
      CHECK(space.inverted_elements == flat.inverted_elements);
      CHECK(space.walls.walls.empty());
      for (const Metric metric : reported_metrics(2)) {
        const Statistics a = flat.of(metric).statistics, b = space.of(metric).statistics;
        CHECK(b.min == doctest::Approx(a.min).epsilon(1e-9));
        CHECK(b.avg == doctest::Approx(a.avg).epsilon(1e-9));
        CHECK(b.max == doctest::Approx(a.max).epsilon(1e-6));
      }
      const Validity v = check_validity(*mesh.topology, mesh.coordinates, 1, options.normals);
      CHECK(v.inverted == flat.inverted);
      CHECK(v.min_sine == doctest::Approx(flat.of(Metric::normalized_jacobian).statistics.min));
      // By itself no triangle is turned over.
      if (cells == Cells::triangles) CHECK(measure_quality(mesh).inverted == 0);
    }
  }
}

TEST_CASE("surface quality: the largest step is that in the plane") {
  Random random(7);
  const MeshData data = square(6, Cells::mixed);
  Mesh plane = make_mesh(data);
  Mesh target = plane;
  tangle(target, random);
  const Mesh from = make_mesh(lifted(data, embedded));
  Coordinates to = from.coordinates;
  for (Index i = 0; i < to.size(); ++i) to.set_xyz(i, embedded(target.coordinates.xy(i)));
  const std::vector<Vec3> normals(at(from.topology->element_count()), turn.col(2));
  const double step = largest_valid_step(*plane.topology, plane.coordinates, target.coordinates);
  CHECK(step < 1);
  CHECK(largest_valid_step_on_surface(*from.topology, from.coordinates, to, normals) ==
        doctest::Approx(step).epsilon(1e-9));
  CHECK(largest_valid_step_on_surface(*from.topology, to, from.coordinates, normals) == 0);
}

TEST_CASE("surface change: distances both ways, and the volume of closed surfaces") {
  const Mesh cube_mesh = make_mesh(skin(cube(3, Volumes::hexahedra)));
  CHECK(enclosed_volume(cube_mesh) == doctest::Approx(1));
  const SurfaceChange none = compare_surfaces(cube_mesh, cube_mesh);
  CHECK(none.hausdorff() == 0);
  CHECK(none.extent == doctest::Approx(std::sqrt(3)));
  // One side's middle is drawn out by .2: the new surface is .2 from the old one, but all places of
  // the old one are nearer to the new one.
  MeshData data = skin(cube(2, Volumes::hexahedra));
  const Mesh before = make_mesh(data);
  for (Index i = 0; i < data.coordinates.size(); ++i) {
    const Vec3 p = data.coordinates.xyz(i);
    if ((p - Vec3(0.5, 0.5, 1)).norm() < 1e-9) data.coordinates.set_xyz(i, {0.5, 0.5, 1.2});
  }
  const Mesh after = make_mesh(data);
  const SurfaceChange change = compare_surfaces(before, after);
  CHECK(change.from_after == doctest::Approx(0.2));
  CHECK(change.from_before > 0.1);
  CHECK(change.from_before < 0.19);
  CHECK(change.hausdorff() == change.from_after);
  REQUIRE(change.volume_before);
  CHECK(*change.volume_before == doctest::Approx(1));
  // Four quadrilaterals of edge .5 with one corner raised by .2, cut along either diagonal.
  CHECK(*change.volume_after > 1.03);
  CHECK(*change.volume_after < 1.07);
  const Mesh open = make_mesh(lifted(square(3, Cells::mixed), embedded));
  CHECK_FALSE(compare_surfaces(open, open).volume_before);
  const Mesh plane = make_mesh(square(3, Cells::mixed));
  CHECK_THROWS_WITH_AS(compare_surfaces(plane, plane),
                       "deviation: only for a surface mesh, and this is a plane mesh", UsageError);
}

}  // namespace winslow::test
