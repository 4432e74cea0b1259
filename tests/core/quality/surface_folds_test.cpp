#include "core/quality/surface_folds.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/quality/quality.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

/// Elements of a mesh around the origin that face inwards.
std::vector<Index> facing_inwards(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  std::vector<Index> list;
  for (Index e = 0; e < mesh.topology->element_count(); ++e)
    if (doubled_area_vector(x, mesh.topology->element(e)).dot(element_centre(mesh, e)) < 0)
      list.push_back(e);
  return list;
}

/// Moves a node of the unit sphere along the sphere.
void drag(Mesh& mesh, Index node, const Vec3& by) {
  mesh.coordinates.set_xyz(node, (mesh.coordinates.xyz(node) + by).normalized());
}

/// A wing without ends: a grid of n cells around a section and m along the span. The upper and the
/// lower side meet at the trailing edge at this angle (degrees); nose: whether the leading edge is
/// round, else it is as sharp.
Mesh wing(Index n, Index m, double angle, bool nose, Cells cells) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  const double slope = std::tan(radians(angle / 2));
  const auto id = [&](Index i, Index j) { return j * n + i % n; };
  for (Index j = 0; j <= m; ++j) {
    for (Index i = 0; i < n; ++i) {
      // From the trailing edge (1, 0) over the upper side to the leading edge and back.
      const double t = 2.0 * i / n, side = t <= 1 ? 1 : -1;
      const double chord = 0.5 * (1 + std::cos(pi * t));
      const double thick = slope * (1 - chord) * (nose ? std::sqrt(chord) : chord);
      data.coordinates.push_xyz(Vec3(chord, side * thick, 3.0 * j / m));
    }
  }
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i)
      add_cell(data, cells, i, j, {id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
  return make_mesh(data);
}

}  // namespace

TEST_CASE("folds: a smooth surface has none, nor has a box with its edges") {
  CHECK_FALSE(find_folds(make_mesh(octasphere(6))).any());
  CHECK_FALSE(find_folds(make_mesh(torus_grid(24, 12, Cells::mixed, [](const Vec2& p) {
                return on_torus(p, 2, 0.6);
              }))).any());
  const SurfaceFolds box = find_folds(make_mesh(skin(cube(4, Volumes::mixed))));
  CHECK_FALSE(box.any());
  CHECK(box.thin_edges == 0);
  CHECK(describe(box).empty());
  CHECK_FALSE(find_folds(make_mesh(square(4, Cells::triangles))).any());
}

TEST_CASE("folds: a node that was dragged over its neighbours is found with what lies behind") {
  Mesh mesh = make_mesh(octasphere(12));
  const Index node = mesh.topology->element(40)[0];
  const Vec3 place = mesh.coordinates.xyz(node);
  const auto around = mesh.topology->neighbours(node);
  drag(mesh, node, 2.6 * (mesh.coordinates.xyz(around[0]) - place));
  const auto backwards = facing_inwards(mesh);
  REQUIRE_FALSE(backwards.empty());
  CHECK(measure_quality(mesh).inverted == 0);  // which is why folds are looked for
  const SurfaceFolds folds = find_folds(mesh);
  CHECK(folds.behind == backwards);
  CHECK(folds.elements == static_cast<Index>(backwards.size()));
  CHECK(folds.of == mesh.topology->element_count());
  CHECK(folds.places.size() == static_cast<std::size_t>(folds.edges));
  for (const SurfaceFolds::Edge& edge : folds.places) {
    const auto first = std::ranges::count(backwards, edge.elements[0]);
    const auto second = std::ranges::count(backwards, edge.elements[1]);
    CHECK(first + second == 1);
    CHECK((edge.centre - place).norm() < 1);
  }
  CHECK(describe(folds) ==
        "the surface is folded: it turns back on itself at " + std::to_string(folds.edges) +
            " edges, by more than 150 degrees, and " + std::to_string(folds.elements) + " of " +
            std::to_string(folds.of) + " elements lie behind them");
  CHECK(measure_quality(mesh).folds.elements == folds.elements);
}

TEST_CASE("folds: of a scrambled sphere, about as many elements as face inwards") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Mesh mesh = make_mesh(octasphere(16));
    for (Index node = 0; node < mesh.topology->node_count(); ++node)
      drag(mesh, node, 0.2 * random_vector(random));
    const auto backwards = static_cast<double>(facing_inwards(mesh).size());
    REQUIRE(backwards > 100);
    const SurfaceFolds folds = find_folds(mesh);
    CHECK(folds.elements > 0.8 * backwards);
    CHECK(folds.elements < 1.2 * backwards);
    CHECK(folds.edges > folds.elements);
    CHECK(folds.behind.size() == 100);
    CHECK(folds.places.size() == 100);
  }
}

TEST_CASE("folds: thin sharp edges are none, however thin") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    for (const double angle : {0.5, 4.0, 12.0, 25.0}) {
      CAPTURE(angle);
      for (const bool nose : {true, false}) {
        CAPTURE(nose);
        const SurfaceFolds folds = find_folds(wing(40, 12, angle, nose, cells));
        CHECK_FALSE(folds.any());
        // A nose that is round, but as thin as a knife, is one more edge.
        CHECK(folds.thin_edges == (nose && angle > 1 ? 12 : 24));
      }
    }
    // With one cell along the span, too: two large sides of a thin body.
    CHECK_FALSE(find_folds(wing(8, 1, 10, false, cells)).any());
    CHECK_FALSE(find_folds(wing(40, 2, 10, true, cells)).any());
  }
}

TEST_CASE("folds: a fold beside a thin trailing edge is found, and the edge stays one") {
  Mesh mesh = wing(40, 12, 6, true, Cells::triangles);
  Coordinates& x = mesh.coordinates;
  const Index n = 40, node = 6 * n + 8;  // on the upper side
  x.set_xyz(node, x.xyz(node) + 1.7 * (x.xyz(node + 1) - x.xyz(node)));
  const SurfaceFolds folds = find_folds(mesh);
  CHECK(folds.thin_edges == 12);
  CHECK(folds.edges >= 3);
  CHECK(folds.elements >= 1);
  CHECK(folds.elements <= 3);
  for (const SurfaceFolds::Edge& edge : folds.places)
    CHECK((edge.centre - x.xyz(node)).norm() < 0.6);
}

TEST_CASE("folds: a strip that is folded over along straight lines is no thin edge") {
  constexpr Index n = 24;
  // Columns 5 and 6 change places.
  const auto across = [](double u) {
    const double column = std::round(n * u);
    return column == 5 ? 6.3 / n : column == 6 ? 4.7 / n : u;
  };
  const auto on_ring = [&](const Vec2& p) { return on_torus(Vec2(across(p.x()), p.y()), 2, 0.6); };
  // No node of the border may lie inside an edge of it.
  const auto on_plane = [&](const Vec2& p) {
    const double out = (across(p.x()) - p.x()) * (p.y() < 0.01 ? 1 : p.y() > 0.99 ? -1 : 0);
    return Vec3(across(p.x()), p.y() + out, 0);
  };
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    CAPTURE(name_of(cells));
    for (const bool plane : {false, true}) {
      CAPTURE(plane);
      const SurfaceFolds folds = find_folds(
          make_mesh(plane ? lifted(square(n, cells), on_plane) : torus_grid(n, n, cells, on_ring)));
      CHECK(folds.elements == (cells == Cells::quads ? n : 2 * n));
      CHECK(folds.edges >= 2 * n);  // some more at the border of the plane
      CHECK(folds.thin_edges == 0);
    }
  }
}

}  // namespace winslow::test
