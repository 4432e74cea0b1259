#include "core/vcv/virtual_control_volumes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// Node 0 with n neighbours.
VirtualControlVolumes star_vcv(Index n) {
  return VirtualControlVolumes(Topology::build(regular_star(n)));
}

}  // namespace

TEST_CASE("a VCV starts as the paper has it: equal angles, unit edges, one triangle per element") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const auto topology = Topology::build(square(6, cells));
    const VirtualControlVolumes vcv(topology);
    CHECK(&vcv.topology() == topology.get());
    for (const Index node : topology->interior_nodes()) {
      const auto n = topology->star(node).size();
      REQUIRE(vcv.angles(node).size() == n);
      REQUIRE(vcv.lengths(node).size() == n);
      for (std::size_t k = 0; k < n; ++k) {
        CHECK(vcv.angles(node)[k] == doctest::Approx(2 * pi / static_cast<double>(n)));
        CHECK(vcv.lengths(node)[k] == 1);
        const double phi = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
        const Vec2 p = vcv.point(node, static_cast<Index>(k));
        CHECK((p - Vec2(std::cos(phi), std::sin(phi))).norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("nodes that are not free have no VCV") {
  const auto topology = Topology::build(square(3, Cells::triangles));
  const VirtualControlVolumes vcv(topology);
  for (Index i = 0; i < topology->node_count(); ++i) {
    CHECK(vcv.angles(i).empty() == topology->on_boundary(i));
    CHECK(vcv.lengths(i).empty() == topology->on_boundary(i));
  }
}

TEST_CASE("set changes one VCV and reset brings it back") {
  const auto topology = Topology::build(square(4, Cells::triangles));
  VirtualControlVolumes vcv(topology);
  const VirtualControlVolumes original = vcv;
  const Index node = topology->interior_nodes()[4];
  REQUIRE(vcv.angles(node).size() == 6);
  const std::vector<double> angles{0.5, 1.0, 1.5, 0.7, 0.8, 2 * pi - 4.5};
  const std::vector<double> lengths{1, 2, 3, 0.5, 1e-6, 1e6};
  vcv.set(node, angles, lengths);
  CHECK(std::ranges::equal(vcv.angles(node), angles));
  CHECK(std::ranges::equal(vcv.lengths(node), lengths));
  CHECK((vcv.point(node, 2) - 3 * Vec2(std::cos(1.5), std::sin(1.5))).norm() < 1e-14);
  for (const Index other : topology->interior_nodes()) {
    if (other == node) continue;
    CHECK(std::ranges::equal(vcv.angles(other), original.angles(other)));
    CHECK(std::ranges::equal(vcv.lengths(other), original.lengths(other)));
  }
  vcv.reset(node);
  CHECK(std::ranges::equal(vcv.angles(node), original.angles(node)));
  CHECK(std::ranges::equal(vcv.lengths(node), original.lengths(node)));
}

TEST_CASE("set refuses what is no VCV and leaves the old one") {
  VirtualControlVolumes vcv = star_vcv(4);
  std::vector<double> angles(4, pi / 2);
  std::vector<double> lengths(4, 1.0);
  Index node = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  SUBCASE("a boundary node") { node = 1; }
  SUBCASE("a negative node") { node = -1; }
  SUBCASE("a node beyond the mesh") { node = 5; }
  SUBCASE("too few angles") { angles.pop_back(); }
  SUBCASE("too many lengths") { lengths.push_back(1); }
  SUBCASE("an angle of zero") { angles = {0, 2, 2, 2 * pi - 4}; }
  SUBCASE("a negative angle") { angles = {-0.5, 2.5, 2.2, 2 * pi - 4.2}; }
  SUBCASE("an angle of pi") { angles = {pi, 1, 1, pi - 2}; }
  SUBCASE("a reflex angle") { angles = {4, 1, 1, 2 * pi - 6}; }
  SUBCASE("a NaN among the angles") { angles[2] = nan; }
  SUBCASE("angles that do not go once around") { angles[2] += 1e-8; }
  SUBCASE("a length of zero") { lengths[1] = 0; }
  SUBCASE("a negative length") { lengths[1] = -1; }
  SUBCASE("a NaN among the lengths") { lengths[3] = nan; }
  SUBCASE("an infinite length") { lengths[3] = infinity; }
  CHECK_THROWS_AS(vcv.set(node, angles, lengths), UsageError);
  for (const double angle : vcv.angles(0)) CHECK(angle == doctest::Approx(pi / 2));
  for (const double length : vcv.lengths(0)) CHECK(length == 1);
}

TEST_CASE("an unused node has no VCV to set") {
  MeshData data = regular_star(4);
  data.coordinates.push_xy({5, 5});
  VirtualControlVolumes vcv(Topology::build(data));
  CHECK(vcv.angles(5).empty());
  CHECK_THROWS_AS(vcv.set(5, {}, {}), UsageError);
}
