#include "core/quality/wall_measures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/quality/mesh_change.h"
#include "core/quality/quality.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

void check_all(const std::vector<double>& values, double wanted) {
  REQUIRE_FALSE(values.empty());
  for (const double value : values) CHECK(value == doctest::Approx(wanted).epsilon(1e-9));
}

}  // namespace

TEST_CASE("quantiles are those of a list that is sorted by hand") {
  std::vector<double> values;
  for (int k = 100; k >= 0; --k) values.push_back(k);  // the q-quantile of 0 .. 100 is 100 q
  values.push_back(std::nan(""));
  const Quantiles q = quantiles_of(values);
  CHECK(q.count == 101);
  CHECK(q.min == 0);
  CHECK(q.low == doctest::Approx(5));
  CHECK(q.median == doctest::Approx(50));
  CHECK(q.high == doctest::Approx(95));
  CHECK(q.max == 100);
  CHECK(quantiles_of({1, 2}).median == doctest::Approx(1.5));
  CHECK(quantiles_of({1, 2}).high == doctest::Approx(1.95));
  CHECK(quantiles_of({7}).low == 7);
  CHECK(quantiles_of({}).count == 0);
}

TEST_CASE("walls are the loops around bodies, with the markers on them") {
  const Mesh mesh = make_mesh(square_with_two_holes(10, Cells::mixed));
  const auto walls = find_walls(mesh);
  REQUIRE(walls.size() == 2);
  CHECK(walls[0].markers.size() == 1);
  CHECK(walls[0].markers[0] != walls[1].markers[0]);
  for (const Wall& wall : walls) {
    CHECK(wall.nodes.size() == 8);
    for (const std::string& name : wall.markers) CHECK(name != "outer");
  }
  CHECK(find_walls(make_mesh(square(4, Cells::quads))).empty());
  CHECK(measure_walls(make_mesh(square(4, Cells::quads))).first_height.count == 0);
}

TEST_CASE("an O-grid has the first height and the growth that it was made with") {
  const double first = 1e-5;
  const Mesh mesh = make_mesh(ring_grid(37, 12, first, 1.2));
  const auto walls = find_walls(mesh);
  REQUIRE(walls.size() == 1);
  check_all(first_heights(mesh, walls[0]), first);
  for (const double tilt : first_edge_tilts(mesh, walls[0])) CHECK(std::abs(tilt) < 1e-6);
  const auto growth = values_of(column_growth(mesh, walls[0]));
  CHECK(growth.size() == 37 * 11);
  check_all(growth, 1.2);
  const WallReport report = measure_walls(mesh);
  CHECK(report.node_count() == 37);
  CHECK(report.first_height.min == doctest::Approx(first).epsilon(1e-9));
  CHECK(report.growth.max == doctest::Approx(1.2).epsilon(1e-9));
}

TEST_CASE("a height is normal to the wall where the edges are not") {
  // Each ring is turned by 0.004 against the one before, less than half a sector: edges off the
  // wall lean by 76 degrees, and the corner that they lead to lies above the wall's next edge.
  const double first = 1e-3, turn = 4;
  const Index sectors = 720;
  const Mesh mesh = make_mesh(ring_grid(sectors, 3, first, 1, turn));
  const Wall wall = find_walls(mesh).front();
  const double along = (1 + first) * std::sin(turn * first);
  const double off = (1 + first) * std::cos(turn * first) - 1;
  check_all(first_edge_tilts(mesh, wall), degrees(std::atan2(along, off)));
  // Distance from the chord, whose normal is turned by half a sector.
  const double half = pi / sectors;
  check_all(first_heights(mesh, wall),
            (1 + first) * std::cos(turn * first - half) - std::cos(half));
}

TEST_CASE(
    "triangles: split quadrilaterals have the height of these, however many edges there are") {
  const double growth = 1.01;
  const Mesh mesh = make_mesh(annulus(48, 4, growth, Cells::mixed));
  const Wall wall = find_walls(mesh).front();
  const auto heights = first_heights(mesh, wall);
  check_all(heights, growth - 1);
  check_all(first_heights(make_mesh(annulus(48, 4, growth, Cells::quads)), wall), growth - 1);
}

TEST_CASE("triangles: apexes between two nodes are as far from the wall as from its chord") {
  const Index sectors = 40;
  const double growth = 1.05;
  const Mesh mesh = make_mesh(annulus(sectors, 4, growth, Cells::triangles));
  const Wall wall = find_walls(mesh).front();
  check_all(first_heights(mesh, wall), growth - std::cos(pi / sectors));
  CHECK(column_growth(mesh, wall).empty());
  CHECK(measure_walls(mesh).growth.count == 0);
}

TEST_CASE("a quadrilateral in a concave corner of a wall is measured by its other corner") {
  // An L-shaped body: cells (2, 2), (3, 2), (2, 3) of a grid of 6 by 6 are missing, so that cell
  // (3, 3) has two edges on the wall.
  MeshData data = grid_with_holes(6, Cells::quads, [](Index i, Index j) {
    return (i == 2 && j == 2) || (i == 3 && j == 2) || (i == 2 && j == 3);
  });
  const Mesh mesh = make_mesh(data);
  const Wall wall = find_walls(mesh).front();
  CHECK(wall.nodes.size() == 8);
  const auto heights = first_heights(mesh, wall);
  REQUIRE(heights.size() == 8);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const Vec2 p = 6 * mesh.coordinates.xy(wall.nodes[k]);
    CAPTURE(p.transpose());
    CHECK(heights[k] == doctest::Approx(1.0 / 6));
  }
}

TEST_CASE("size ratios are of areas across shared edges") {
  const double growth = 1.3;
  const Mesh mesh = make_mesh(annulus(24, 5, growth, Cells::quads));
  const auto ratios = values_of(size_ratios(mesh));
  std::size_t across = 0;
  for (const double ratio : ratios) {
    const bool along_ring = std::abs(ratio - 1) < 1e-9;
    if (!along_ring) CHECK(ratio == doctest::Approx(growth));  // similar cells: lengths scale
    across += along_ring ? 0 : 1;
  }
  CHECK(across == 24 * 4);
  CHECK(ratios.size() == 24 * 4 + 24 * 5);
}

TEST_CASE("first heights of two meshes are compared node by node") {
  const Mesh before = make_mesh(ring_grid(40, 6, 0.01, 1.2));
  Mesh after = before;
  const Index node = 40 + 7;  // above node 7 of the wall
  after.coordinates.set_xy(node, 1.013 * before.coordinates.xy(7));
  const auto change =
      compare_first_heights(measure_walls(before).walls, measure_walls(after).walls);
  REQUIRE(change);
  CHECK(change->ratio.count == 40);
  CHECK(change->worst_node == 7);
  CHECK(change->worst_ratio == doctest::Approx(1.3));
  CHECK(change->off == doctest::Approx(1.0 / 40));
  CHECK(change->ratio.median == doctest::Approx(1));
  CHECK(spoils_walls(*change));  // one node, but by more than a fifth
  const Mesh other = make_mesh(ring_grid(41, 6, 0.01, 1.2));
  CHECK_FALSE(compare_first_heights(measure_walls(before).walls, measure_walls(other).walls));
}

TEST_CASE("heights of isotropic cells may change by half before that is damage") {
  // Edges along the wall of .157, heights of .15 and of .05.
  const Mesh isotropic = make_mesh(ring_grid(40, 6, 0.15, 1.2));
  const Mesh stretched = make_mesh(ring_grid(40, 6, 0.05, 1.2));
  const auto raised = [](const Mesh& mesh, double height) {
    Mesh after = mesh;
    for (Index k = 0; k < 20; ++k)
      after.coordinates.set_xy(40 + k, (1 + height) * mesh.coordinates.xy(k));
    return after;
  };
  const auto change = [](const Mesh& a, const Mesh& b) {
    return compare_first_heights(measure_walls(a).walls, measure_walls(b).walls).value();
  };
  const FirstHeightChange less = change(isotropic, raised(isotropic, 1.4 * 0.15));
  CHECK(less.off == doctest::Approx(0.5));  // the figures are what they were
  CHECK(less.harmed_node == -1);
  CHECK_FALSE(spoils_walls(less));
  CHECK(find_damage(isotropic, raised(isotropic, 1.4 * 0.15)).text.empty());
  CHECK(spoils_walls(change(stretched, raised(stretched, 1.4 * 0.05))));
  const Damage more = find_damage(isotropic, raised(isotropic, 1.6 * 0.15));
  CHECK(more.text.starts_with(
      "first heights changed by a factor of more than 1.5 at 50 % of the wall nodes, at worst to "
      "1.6 times"));
  CHECK(find_damage(stretched, raised(stretched, 1.1 * 0.05))
            .text.starts_with("first heights changed by more than 5 % at 50 % of the wall nodes"));
}

TEST_CASE("damage is named with its figures and its place, and only where there is any") {
  const Mesh before = make_mesh(ring_grid(40, 6, 0.01, 1.2));
  Mesh after = before;
  CHECK(find_damage(before, after).text.empty());
  after.coordinates.set_xy(40, Vec2(1.0115, 0));
  CHECK(find_damage(before, after).text.empty());  // 1 of 40 by 15 %
  after.coordinates.set_xy(40, Vec2(1.005, 0));
  Damage found = find_damage(before, after);
  std::string damage = found.text;
  CHECK(found.node == 0);
  CHECK_FALSE(found.element.has_value());
  CHECK(damage.find("at 2.5 % of the wall nodes, at worst to 0.5 times what they were at (1, 0)") !=
        std::string::npos);
  CHECK(damage.find("sine") == std::string::npos);
  // A node of the third ring slides along it, so that edges lean which are far from the wall.
  after = before;
  const Index node = 3 * 40;
  const double radius = before.coordinates.xy(node).x();
  after.coordinates.set_xy(node, radius * Vec2(std::cos(0.1), std::sin(0.1)));
  found = find_damage(before, after);
  damage = found.text;
  CHECK_FALSE(found.node.has_value());
  REQUIRE(found.element.has_value());
  CHECK(found.element == worst_element(after, Metric::normalized_jacobian));
  const auto corners = after.topology->element(*found.element);
  CHECK(std::ranges::find(corners, node) != corners.end());
  CHECK(damage.starts_with("the smallest sine fell from "));
  // From a tenth on. The angle by which edges lean grows with the way.
  const double given = check_validity(*before.topology, before.coordinates).min_sine;
  for (const double way : {0.005, 0.01, 0.015, 0.02, 0.03}) {
    CAPTURE(way);
    after.coordinates.set_xy(node, radius * Vec2(std::cos(way), std::sin(way)));
    const double left = check_validity(*after.topology, after.coordinates).min_sine / given;
    CHECK(find_damage(before, after).text.empty() == (left >= 0.9));
    if (way == 0.005) CHECK(left > 0.9);
    if (way == 0.03) CHECK(left < 0.9);
  }
  Mesh tangled = before;
  tangled.coordinates.set_xy(node, Vec2(0, 0));
  CHECK(find_damage(before, tangled).text.empty());
  CHECK(find_damage(tangled, before).text.empty());
}

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
