#include "core/quality/wall_field.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/quality/quality.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr Index sectors = 24;

/// Quadrilaterals around a circle, every row of another height, all nodes but the wall's moved at
/// random.
Mesh uneven() {
  Mesh mesh = make_mesh(o_grid(sectors, distances(6, 0.02, 1.3, 6), Cut::none));
  Random random(7);
  perturb(mesh, random, 0.2);
  return mesh;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Nodes i of the first ring are the wall's, i + sectors those above them: the least distance of
/// that to any edge of the wall.
std::array<double, sectors> heights_by_all_edges(const Coordinates& x) {
  std::array<double, sectors> heights;
  heights.fill(1e300);
  for (Index i = 0; i < sectors; ++i)
    for (Index k = 0; k < sectors; ++k)
      heights[at(i)] =
          std::min(heights[at(i)], distance(x.xy(i + sectors), x.xy(k), x.xy((k + 1) % sectors)));
  return heights;
}

double shoelace(const Mesh& mesh, Index e) {
  const auto nodes = mesh.topology->element(e);
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec2 a = mesh.coordinates.xy(nodes[k]);
    const Vec2 b = mesh.coordinates.xy(nodes[(k + 1) % nodes.size()]);
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

Index shared_nodes(const Topology& topology, Index e, Index f) {
  Index shared = 0;
  for (const Index node : topology.element(e))
    shared += static_cast<Index>(std::ranges::count(topology.element(f), node));
  return shared;
}

/// The worst of these values by a scan: the element and what makes it worst.
Index scan(const std::vector<double>& values, double (*badness)(double)) {
  Index worst = -1;
  for (std::size_t e = 0; e < values.size(); ++e) {
    if (std::isnan(values[e])) continue;
    if (worst < 0 || badness(values[e]) > badness(values[at(worst)])) worst = static_cast<Index>(e);
  }
  return worst;
}

}  // namespace

TEST_CASE("size ratios of elements are those of all pairs that share two nodes") {
  const Mesh mesh = uneven();
  const auto values = element_values(mesh, WallField::size_ratio);
  const Index n = mesh.topology->element_count();
  for (Index e = 0; e < n; ++e) {
    double most = 0;
    for (Index f = 0; f < n; ++f) {
      if (f == e || shared_nodes(*mesh.topology, e, f) != 2) continue;
      const double ratio = std::sqrt(shoelace(mesh, e) / shoelace(mesh, f));
      most = std::max({most, ratio, 1 / ratio});
    }
    CHECK(values[at(e)] == doctest::Approx(most));
  }
}

TEST_CASE("growth of elements is that to the cells below and above them in their column") {
  const Mesh mesh = uneven();
  const Coordinates& x = mesh.coordinates;
  const auto values = element_values(mesh, WallField::growth);
  // Row k, sector i of the grid, by its four nodes.
  const auto height = [&](Index k, Index i) {
    const auto middle = [&](Index row) {
      return Vec2(0.5 * (x.xy(row * sectors + i) + x.xy(row * sectors + (i + 1) % sectors)));
    };
    return (middle(k + 1) - middle(k)).norm();
  };
  constexpr Index rows = 6;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const Index least = *std::ranges::min_element(mesh.topology->element(e));
    const Index k = least / sectors;
    std::set<Index> places;
    for (const Index node : mesh.topology->element(e)) places.insert(node % sectors);
    REQUIRE(places.size() == 2);
    const Index i =
        places.contains(0) && places.contains(sectors - 1) ? sectors - 1 : *places.begin();
    double most = 0;
    for (const Index other : {k - 1, k + 1}) {
      if (other < 0 || other >= rows) continue;
      const double ratio = height(k, i) / height(other, i);
      most = std::max({most, ratio, 1 / ratio});
    }
    CHECK(values[at(e)] == doctest::Approx(most));
  }
  const WallReport report = measure_walls(mesh);
  CHECK(*std::ranges::max_element(values) == doctest::Approx(report.growth.max));
}

TEST_CASE("first heights over before are at the end of an edge that has changed by more") {
  const Mesh before = make_mesh(o_grid(sectors, distances(6, 0.02, 1.3, 6), Cut::none));
  const Mesh now = uneven();
  const auto were = heights_by_all_edges(before.coordinates);
  const auto are = heights_by_all_edges(now.coordinates);
  const auto values = element_values(now, WallField::first_height_ratio, &before.coordinates);
  Index at_wall = 0;
  for (Index e = 0; e < now.topology->element_count(); ++e) {
    double ratio = 1;
    Index on_wall = 0;
    for (const Index node : now.topology->element(e)) {
      if (node >= sectors) continue;
      ++on_wall;
      const double own = are[at(node)] / were[at(node)];
      if (std::abs(std::log(own)) > std::abs(std::log(ratio))) ratio = own;
    }
    REQUIRE(std::isnan(values[at(e)]) == (on_wall == 0));
    if (on_wall == 0) continue;
    ++at_wall;
    CHECK(values[at(e)] == doctest::Approx(ratio));
  }
  CHECK(at_wall == sectors);
  // Nothing to compare with, or another mesh.
  for (const double v : element_values(now, WallField::first_height_ratio)) CHECK(std::isnan(v));
  const Coordinates other = make_mesh(square(3, Cells::quads)).coordinates;
  for (const double v : element_values(now, WallField::first_height_ratio, &other))
    CHECK(std::isnan(v));
}

TEST_CASE("a report lists the worst elements by every field of walls") {
  const Mesh before = make_mesh(o_grid(sectors, distances(6, 0.02, 1.3, 6), Cut::none));
  const Mesh now = uneven();
  QualityOptions options;
  options.worst = 3;
  options.before = &before.coordinates;
  const QualityReport report = measure_quality(now, options);
  const auto largest = [](double v) { return v; };
  const auto smallest = [](double v) { return -v; };
  const auto furthest = [](double v) { return std::max(v, 1 / v); };
  const std::array<double (*)(double), 5> badness{smallest, furthest, largest, largest, largest};
  for (const WallField field : all_wall_fields()) {
    CAPTURE(wall_field_info(field).name);
    const auto& worst = report.worst_by(field);
    REQUIRE(worst.size() == 3);
    const auto values = element_values(now, field, &before.coordinates);
    const Index first = scan(values, badness[static_cast<std::size_t>(field)]);
    CHECK(worst[0].element == first);
    CHECK(worst[0].value == values[at(first)]);
    CHECK(worst[0].centre == element_centre(now, first));
  }
  options.before = nullptr;
  CHECK(measure_quality(now, options).worst_by(WallField::first_height_ratio).empty());
  options.worst = 0;
  CHECK(measure_quality(now, options).worst_by(WallField::growth).empty());
}

TEST_CASE("walls of triangles have no growth, a mesh without a body no heights") {
  const Mesh triangles = make_mesh(annulus(24, 4, 1.2, Cells::triangles));
  for (const double v : element_values(triangles, WallField::growth)) CHECK(std::isnan(v));
  const Mesh plain = make_mesh(square(4, Cells::quads));
  for (const double v : element_values(plain, WallField::first_height)) CHECK(std::isnan(v));
  for (const double v : element_values(plain, WallField::size_ratio))
    CHECK(v == doctest::Approx(1));
}
