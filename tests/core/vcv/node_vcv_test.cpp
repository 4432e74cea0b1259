#include "core/vcv/sphere/node_vcv.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "support/links.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("the VCV of one node is that of all, which are kept in single precision") {
  const Mesh mesh = shaken_box(4, 0.2, 7, Volumes::mixed);
  for (const VcvAngles angles : {VcvAngles::equal, VcvAngles::existing, VcvAngles::adjusted}) {
    for (const double power : {0.0, 0.5}) {
      CAPTURE(power);
      VolumeVcvOptions options;
      options.angles = angles;
      options.length_power = power;
      const VolumeVcvs all(mesh.topology, mesh.coordinates, options);
      const auto interior = mesh.topology->interior_nodes();
      std::vector<double> targets;
      for (std::size_t i = 0; i < interior.size(); ++i) {
        const NodeVcv one = make_node_vcv(*mesh.topology, mesh.coordinates, interior[i], options);
        std::vector<Vec3> points;
        all.points(interior[i], points);
        const std::vector<Vec3> own = one.points();
        REQUIRE(own.size() == points.size());
        for (std::size_t k = 0; k < own.size(); ++k) CHECK((own[k] - points[k]).norm() < 1e-6);
        CHECK(one.end == all.fit_end(i));
        all.targets(i, one.link, targets);
        REQUIRE(one.targets.size() == targets.size());
        for (std::size_t t = 0; t < targets.size(); ++t)
          CHECK(one.targets[t] == doctest::Approx(targets[t]).epsilon(1e-6));
        CHECK_FALSE(one.edited);
      }
    }
  }
}

TEST_CASE("the VCV of a node by hand is the one that was given; a node of the boundary has none") {
  const Mesh mesh = make_mesh(cube(2, Volumes::hexahedra));
  const Index node = mesh.topology->interior_nodes().front();
  const NodeVcv own = make_node_vcv(*mesh.topology, mesh.coordinates, node, {});
  SphereStencil by_hand = own.stencil;
  by_hand.lengths[2] = 3;
  const NodeVcv given = make_node_vcv(*mesh.topology, mesh.coordinates, node, {}, &by_hand);
  CHECK(given.edited);
  CHECK(given.stencil == by_hand);
  CHECK(given.targets == own.targets);
  CHECK(given.points()[2] == Vec3(3 * own.points()[2]));
  CHECK_THROWS_AS(make_node_vcv(*mesh.topology, mesh.coordinates, 0, {}), UsageError);
  CHECK_THROWS_AS(make_node_vcv(*mesh.topology, mesh.coordinates, -1, {}), UsageError);
}

TEST_CASE("edits of VCVs in space: any order of neighbours, resets, and what is refused") {
  const Mesh mesh = make_mesh(cube(2, Volumes::hexahedra));
  const Topology& topology = *mesh.topology;
  const Index node = topology.interior_nodes().front();
  const SphereStencil own = make_node_vcv(topology, mesh.coordinates, node, {}).stencil;
  VcvEdit edit = edit_of(topology, node, own);
  edit.lengths = {1, 2, 3, 4, 5, 6};
  const auto straight = edit_vcvs(topology, nullptr, std::span(&edit, 1));
  REQUIRE(straight);
  CHECK(straight->at(node).lengths == edit.lengths);
  VcvEdit turned = edit;
  std::reverse(turned.neighbours.begin(), turned.neighbours.end());
  std::reverse(turned.lengths.begin(), turned.lengths.end());
  std::reverse(turned.directions.begin(), turned.directions.end());
  for (Vec3& d : turned.directions) d *= 7;  // only where they point to
  const auto same = edit_vcvs(topology, straight.get(), std::span(&turned, 1));
  CHECK(same->at(node).lengths == straight->at(node).lengths);
  for (std::size_t k = 0; k < 6; ++k)
    CHECK((same->at(node).directions[k] - straight->at(node).directions[k]).norm() < 1e-15);

  const VcvEdit reset{node, {}, {}, {}};
  CHECK(edit_vcvs(topology, straight.get(), std::span(&reset, 1)) == nullptr);

  const auto refused = [&](const VcvEdit& bad) {
    CHECK_THROWS_AS(edit_vcvs(topology, straight.get(), std::span(&bad, 1)), UsageError);
  };
  VcvEdit bad = edit;
  bad.directions[0] = bad.directions[1];
  refused(bad);
  bad = edit;
  bad.directions.pop_back();
  refused(bad);
  bad = edit;
  bad.lengths[3] = -1;
  refused(bad);
  bad = edit;
  bad.neighbours[0] = 0;
  refused(bad);
  bad = edit;
  bad.directions.clear();
  refused(bad);  // lengths alone
  bad = edit;
  bad.angles = {60, 60, 60, 60, 60, 60};
  refused(bad);
  bad = edit;
  bad.node = 0;
  refused(bad);
}

TEST_CASE("the least angle at a vertex falls to zero where a triangle is about to turn over") {
  const SphereLink link = link_of(double_pyramid(4));  // an octahedron
  std::vector<Vec3> d{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  CHECK(least_angle_at(link, d, 4).share == doctest::Approx(1));
  d[4] = Vec3(1, 0, 0.05).normalized();  // nearly on the edge's end
  const LeastAngle near = least_angle_at(link, d, 4);
  CHECK(near.share > 0);
  CHECK(near.share < 0.1);
  d[4] = Vec3(1, 0, -0.05).normalized();
  const LeastAngle beyond = least_angle_at(link, d, 4);
  CHECK(beyond.share < 0);
  const auto& triangle = link.triangles()[at(beyond.triangle)];
  CHECK(std::find(triangle.begin(), triangle.end(), 4) != triangle.end());
}
