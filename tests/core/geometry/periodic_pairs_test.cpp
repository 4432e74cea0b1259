#include "core/geometry/periodic_pairs.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

namespace winslow::test {

TEST_CASE("sides that a translation takes to one another are paired, their ends left out") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  const auto found = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "left", "right");
  CHECK(found.description == "translation by (1, 0)");
  REQUIRE(found.pairs.size() == 5);
  for (const auto& [node, image] : found.pairs) {
    const Vec2 p = mesh.coordinates.xy(node), q = mesh.coordinates.xy(image);
    CHECK(p.x() == 0);
    CHECK((q - p - Vec2(1, 0)).norm() < 1e-15);
  }
}

TEST_CASE("sides that a rotation takes to one another are paired") {
  for (const double angle : {20.0, 90.0, 120.0}) {
    CAPTURE(angle);
    const Mesh mesh = make_mesh(sector(angle, 6, 5, {3, -2}));
    const auto found = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "begin", "end");
    CHECK(found.description == "rotation by " + number_text(angle) + " degrees");
    CHECK(found.pairs.size() == 4);
    for (const auto& [node, image] : found.pairs) {
      const Vec2 p = mesh.coordinates.xy(node), q = mesh.coordinates.xy(image);
      const Vec3 mapped = found.image.of({p.x(), p.y(), 0});
      CHECK((mapped.head<2>() - q).norm() < 1e-13);
      CHECK(mapped.z() == 0);
    }
  }
}

TEST_CASE("sides of volume meshes are paired, by translation and by rotation about an axis") {
  MeshData data = cube(3, Volumes::tetrahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    return p.x() < 1e-9 ? "first" : p.x() > 1 - 1e-9 ? "second" : "rest";
  });
  const Mesh box = make_mesh(data);
  const auto shifted = PeriodicPairs::find(*box.topology, box.coordinates, "first", "second");
  CHECK(shifted.description == "translation by (1, 0, 0)");
  CHECK(shifted.pairs.size() == 4);
  // The same box bent round the z axis.
  for (Index node = 0; node < data.coordinates.size(); ++node) {
    const Vec3 p = data.coordinates.xyz(node);
    const double phi = radians(30 * p.x()), r = 1 + p.y();
    data.coordinates.set_xyz(node, {r * std::cos(phi), r * std::sin(phi), p.z()});
  }
  const Mesh bent = make_mesh(data);
  const auto turned = PeriodicPairs::find(*bent.topology, bent.coordinates, "first", "second");
  CHECK(turned.description == "rotation by 30 degrees");
  CHECK(turned.pairs.size() == 4);
}

TEST_CASE("sides that do not match are refused, and the pair that does not is named") {
  MeshData data = square(6, Cells::triangles);
  for (Index node = 0; node < data.coordinates.size(); ++node) {
    const Vec2 p = data.coordinates.xy(node);
    if (p.x() > 1 - 1e-9 && std::abs(p.y() - 0.5) < 1e-9)
      data.coordinates.set_xy(node, p + Vec2(0, 0.05));
  }
  const Mesh mesh = make_mesh(data);
  const auto pair = [&](const std::string& a, const std::string& b) {
    return PeriodicPairs::find(*mesh.topology, mesh.coordinates, a, b);
  };
  CHECK_THROWS_WITH_AS(pair("left", "right"), doctest::Contains("at (0, 0.5)"), UsageError);
  CHECK_THROWS_WITH_AS(pair("left", "left"), doctest::Contains("twice"), UsageError);
  CHECK_THROWS_WITH_AS(pair("left", "lid"), doctest::Contains("lid"), UsageError);
  const Mesh other = make_mesh(square_with_hole(10, Cells::triangles));
  CHECK_THROWS_WITH_AS(PeriodicPairs::find(*other.topology, other.coordinates, "outer", "hole"),
                       doctest::Contains("40 and 8 nodes"), UsageError);
}

}  // namespace winslow::test
