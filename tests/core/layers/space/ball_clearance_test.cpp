#include "core/layers/space/ball_clearance.h"

#include <doctest/doctest.h>

#include "core/layers/space/wall_surface.h"
#include "support/walled_meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("the nearest point of a triangle is that of a fine search") {
  Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const std::array<Vec3, 3> corners{random_vector(random), random_vector(random),
                                      random_vector(random)};
    const Vec3 p = 2 * random_vector(random);
    double least = 1e9;
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
        const Vec3 q = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
        least = std::min(least, (q - p).norm());
      }
    }
    const Vec3 found = nearest_of_triangle(p, corners);
    CHECK((found - p).norm() <= least + 1e-12);
    CHECK((found - p).norm() >= least - 0.02);
  }
}

TEST_CASE("the clearance in a gap is half its width, and nothing limits it beside a wall") {
  const Mesh mesh = make_mesh(cube(8, Volumes::tetrahedra));
  const BallClearance clearance(mesh);
  const auto floor = mesh.topology->markers().nodes(*mesh.topology->markers().find("floor"));
  for (const Index node : floor) {
    const Vec3 p = mesh.coordinates.xyz(node);
    CHECK(clearance.radius(node, {0, 0, 1}, 10) == doctest::Approx(0.5).epsilon(2e-3));
    CHECK(clearance.radius(node, {0, 0, 1}, 0.2) == 0.2);
    // Obliquely towards a side: by the distance along the column from the side.
    if (p.x() > 0.1 || std::abs(p.y() - 0.5) > 0.1) continue;
    CHECK(clearance.radius(node, Vec3(1, 0, 1).normalized(), 10) < 1);
  }
}

TEST_CASE("inside a sphere the clearance is its radius") {
  // A cube whose nodes lie on spheres about its middle.
  MeshData data = cube(12, Volumes::tetrahedra);
  for (Index node = 0; node < data.node_count(); ++node) {
    const Vec3 q = data.coordinates.xyz(node) - Vec3::Constant(0.5);
    if (q.norm() > 0) data.coordinates.set_xyz(node, q * (q.cwiseAbs().maxCoeff() / q.norm()));
  }
  const Mesh mesh = make_mesh(data);
  const BallClearance clearance(mesh);
  for (Index node = 0; node < data.node_count(); node += 7) {
    const Vec3 p = mesh.coordinates.xyz(node);
    if (p.norm() < 0.5 - 1e-9) continue;
    CHECK(clearance.radius(node, -p.normalized(), 10) == doctest::Approx(0.5).epsilon(0.05));
  }
}

TEST_CASE("between two bodies the gap counts, not the bodies' own backs") {
  const Mesh mesh = box_with_slab(8, 2, 3, Volumes::hexahedra);
  const BallClearance clearance(mesh);
  const WallSurface surface =
      find_wall_surface(mesh, std::vector<LayerWall>{{{"body"}, {.count = 1, .first = 0.01}}});
  for (const Index node : surface.nodes) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const bool middle = std::abs(p.x() - 0.5) < 0.2 && std::abs(p.y() - 0.5) < 0.2;
    if (!middle) continue;
    const bool above = p.z() > 0.3;
    const double gap = above ? 1 - 3.0 / 8 : 2.0 / 8;
    const Vec3 up(0, 0, above ? 1 : -1);
    CHECK(2 * clearance.radius(node, up, 10) == doctest::Approx(gap).epsilon(2e-3));
  }
}
