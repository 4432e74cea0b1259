#include "core/formulation/target_shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/error.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// |J|^2 / (2 det J) of a physical triangle against a term: 1 if it has the target's shape.
double distortion(const ShapeTerm& term, const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double area = 0.5 * (u.x() * v.y() - u.y() * v.x());
  return (term.ab * u.squaredNorm() + term.ac * v.squaredNorm() + term.bc * (c - b).squaredNorm()) /
         (4 * area);
}

/// All free nodes with right angles, long edges sideways (to the first and third neighbour of each
/// VCV, whichever way it lies): targets of an anisotropic grid.
VirtualControlVolumes stretched(const std::shared_ptr<const Topology>& topology,
                                const Coordinates& x, double ratio) {
  VirtualControlVolumes vcv(topology);
  for (const Index node : topology->interior_nodes()) {
    std::vector<double> lengths;
    for (const Index other : topology->neighbours(node)) {
      const Vec2 edge = x.xy(other) - x.xy(node);
      lengths.push_back(std::abs(edge.x()) > std::abs(edge.y()) ? ratio : 1);
    }
    vcv.set(node, std::vector<double>(lengths.size(), pi / 2), lengths);
  }
  return vcv;
}

}  // namespace

TEST_CASE("corners at the boundary take the parallelogram of the VCVs beside them") {
  const MeshData data = square(4, Cells::quads);
  const auto topology = Topology::build(data);
  const auto vcv = stretched(topology, data.coordinates, 5);
  const TargetShapes shapes = TargetShapes::build(vcv, TargetBlend::regular(), nullptr);
  // Every corner that can move, also those at walls, wants a rectangle of 5 by 1: on the mesh drawn
  // out sideways by 5 all distortions are 1.
  int at_boundary = 0;
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    const auto place = [&](Index node) {
      const Vec2 p = data.coordinates.xy(node);
      return Vec2(5 * p.x(), p.y());
    };
    const auto [a, b, c] = shapes.cells[t];
    at_boundary += topology->on_boundary(a) ? 1 : 0;
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      CHECK(distortion(shapes.terms[static_cast<std::size_t>(k)], place(a), place(b), place(c)) ==
            doctest::Approx(1).epsilon(1e-12));
    }
  }
  CHECK(at_boundary > 0);
}

TEST_CASE("a parallelogram that leans: from the VCV opposite, before and after") {
  // One interior node of a 2 by 2 grid: its four elements are each opposite-corner cases.
  const MeshData data = square(2, Cells::quads);
  const auto topology = Topology::build(data);
  const Index centre = topology->interior_nodes()[0];
  VirtualControlVolumes vcv(topology);
  const std::vector<double> angles{radians(70), radians(110), radians(70), radians(110)};
  const std::vector<double> lengths{2, 1, 2, 1};
  vcv.set(centre, angles, lengths);
  const TargetShapes shapes = TargetShapes::build(vcv, TargetBlend::regular(), nullptr);
  // Place the grid as the lattice that this VCV spans.
  Coordinates x = data.coordinates;
  const auto row = topology->neighbours(centre);
  x.set_xy(centre, Vec2(0, 0));
  for (Index k = 0; k < 4; ++k) x.set_xy(row[static_cast<std::size_t>(k)], vcv.point(centre, k));
  const auto star = topology->star(centre);
  for (Index k = 0; k < 4; ++k) {
    for (const Index node : topology->element(star[static_cast<std::size_t>(k)])) {
      const bool known = node == centre || std::find(row.begin(), row.end(), node) != row.end();
      if (!known) x.set_xy(node, vcv.point(centre, k) + vcv.point(centre, (k + 1) % 4));
    }
  }
  REQUIRE(shapes.cells.size() > 4);
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    const auto [a, b, c] = shapes.cells[t];
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      CHECK(distortion(shapes.terms[static_cast<std::size_t>(k)], x.xy(a), x.xy(b), x.xy(c)) ==
            doctest::Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("the role of an element: its weight, and whether it follows edited VCVs") {
  const auto topology = Topology::build(square(4, Cells::triangles));
  VirtualControlVolumes vcv(topology);
  const Index node = topology->interior_nodes()[4];
  const std::size_t count = topology->neighbours(node).size();
  std::vector<double> lengths(count, 1.0);
  lengths[0] = 3;
  vcv.set(node, std::vector<double>(count, 2 * pi / static_cast<double>(count)), lengths);
  ElementRoles roles(static_cast<std::size_t>(topology->element_count()));
  const Index follows = topology->star(node)[0], keeps = topology->star(node)[1];
  SUBCASE("inserted") { roles[static_cast<std::size_t>(follows)] = ElementRole::layer; }
  SUBCASE("found") { roles[static_cast<std::size_t>(follows)] = ElementRole::found_layer; }
  const double expected = role_weight(roles[static_cast<std::size_t>(follows)]);
  CHECK(expected >= 1e3);
  roles[static_cast<std::size_t>(keeps)] = ElementRole::beside_layers;
  const auto build = [&] {
    return TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, nullptr, {}, &roles);
  };
  const TargetShapes shapes = build();
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    double weight = 0;
    bool equilateral = true;
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      const ShapeTerm& term = shapes.terms[static_cast<std::size_t>(k)];
      weight += term.weight;
      equilateral = equilateral && std::abs(term.ab - term.ac) < 1e-12;
    }
    const auto is = [&](Index element) {
      const auto corners = topology->element(element);
      return std::is_permutation(corners.begin(), corners.end(), shapes.cells[t].begin());
    };
    CHECK(weight == doctest::Approx(is(follows) ? expected : 1));
    if (is(follows)) CHECK_FALSE(equilateral);
    if (is(keeps)) CHECK(equilateral);
  }
  roles.pop_back();
  CHECK_THROWS_AS(build(), UsageError);
}
