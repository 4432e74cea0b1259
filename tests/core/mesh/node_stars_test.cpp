#include "core/mesh/node_stars.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// Mean distance from one node to the next.
double mean_step(const SpacePoints& x, const std::vector<Index>& nodes) {
  double sum = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k) sum += (x[nodes[k]] - x[nodes[k - 1]]).norm();
  return sum / static_cast<double>(nodes.size() - 1);
}

}  // namespace

TEST_CASE("an order along the curve: all once, and nodes near one another however they came") {
  Random random(3);
  const MeshData data = shuffled_volume(cube(16, Volumes::hexahedra), random, false);
  const SpacePoints x(data.coordinates);
  const Box<3> unit{{0, 0, 0}, {1, 1, 1}};
  const CompressedRows corners{data.element_offsets, data.element_nodes};
  const CurveOrder order(x, data.node_count(), unit, corners);
  for (std::size_t e = 0; e < order.elements.size(); ++e) {
    const auto own = order.corners[static_cast<Index>(e)];
    const auto given = corners[order.elements[e]];
    REQUIRE(own.size() == given.size());
    for (std::size_t k = 0; k < own.size(); ++k) CHECK(order.nodes[at(own[k])] == given[k]);
  }
  std::vector<Index> elements = order.elements;
  std::ranges::sort(elements);
  for (std::size_t e = 0; e < elements.size(); ++e) CHECK(elements[e] == static_cast<Index>(e));
  std::vector<Index> nodes = order.nodes;
  std::vector<Index> given(nodes.size());
  for (std::size_t k = 0; k < given.size(); ++k) given[k] = static_cast<Index>(k);
  CHECK(mean_step(x, given) > 0.5);
  CHECK(mean_step(x, nodes) < 2.0 / 16);
  std::ranges::sort(nodes);
  CHECK(nodes == given);
}

TEST_CASE(
    "an order along the curve: nodes outside the box, in one point and in a box without end") {
  Coordinates x(3, 4);
  x.set_xyz(1, {5, -5, 1e308});
  x.set_xyz(2, {-1e308, 0.5, 0.5});
  x.set_xyz(3, {0.5, 0.5, 0.5});
  for (const Box<3>& box : {Box<3>{{0, 0, 0}, {1, 1, 1}}, Box<3>{},
                            Box<3>{Vec3::Constant(-1e308), Vec3::Constant(1e308)}}) {
    std::vector<Index> nodes = CurveOrder(SpacePoints(x), 4, box, {}).nodes;
    std::ranges::sort(nodes);
    CHECK(nodes == std::vector<Index>{0, 1, 2, 3});
  }
}
