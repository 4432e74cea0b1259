#include "gui/document/selection/boundary_index.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "gui/support/meshes.h"

namespace winslow::gui::test {

TEST_CASE("the boundary index finds rims, holes and nothing") {
  const Mesh mesh = two_body_mesh();
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  const Index left = *mesh.topology->markers().find("left");
  const Index outer = *mesh.topology->markers().find("outer");

  const auto rim = index.pick(Vec2(-1.45, 0.2), 0.1);
  REQUIRE(rim.has_value());
  CHECK(rim->marker == left);
  CHECK(rim->hole);
  CHECK_FALSE(rim->inside);
  const auto inside = index.pick(Vec2(-2, 0), 0.1);
  REQUIRE(inside.has_value());
  CHECK(inside->inside);
  CHECK(inside->markers == std::vector<Index>{left});
  const auto edge = index.pick(Vec2(1, 2.05), 0.1);
  REQUIRE(edge.has_value());
  CHECK(edge->marker == outer);
  CHECK_FALSE(edge->hole);
  CHECK_FALSE(index.pick(Vec2(0, 0), 0.1).has_value());
  CHECK_FALSE(index.pick(Vec2(20, 0), 0.1).has_value());

  Coordinates moved = mesh.coordinates;
  for (Index node : mesh.topology->markers().nodes(left))
    moved.set_xy(node, moved.xy(node) + Vec2(1.5, 0));
  index.update(moved);
  CHECK_FALSE(index.pick(Vec2(-2.4, 0), 0.05).has_value());
  REQUIRE(index.pick(Vec2(-0.5, 0), 0.05).has_value());
  CHECK(index.pick(Vec2(-0.5, 0), 0.05)->marker == left);
}

TEST_CASE("bodies are told from rims far from the origin, where areas would cancel") {
  // Small bodies many times: of a wrong sign some would show.
  const Vec2 away(1e7, -3e7);
  for (int k = 0; k < 20; ++k) {
    Mesh mesh = two_body_mesh();
    const double size = std::pow(0.7, k);
    for (Index i = 0; i < mesh.coordinates.size(); ++i)
      mesh.coordinates.set_xy(i, size * mesh.coordinates.xy(i) + away);
    BoundaryIndex index(mesh.topology);
    index.update(mesh.coordinates);
    CHECK(std::ranges::count_if(index.bodies(), [](const auto& body) { return body.hole; }) == 2);
    const auto inside = index.pick(Vec2(away + size * Vec2(-2, 0)), 0.1 * size);
    REQUIRE(inside.has_value());
    CHECK(inside->markers == std::vector<Index>{*mesh.topology->markers().find("left")});
  }
}

TEST_CASE("the nearest boundary edge is the one a search through all of them finds") {
  const Mesh mesh = ring_mesh(60, 3);
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  const Index flap = *mesh.topology->markers().find("flap");
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.1 * k;
    const double radius = 0.2 + 0.013 * k;
    const Vec2 p(radius * std::cos(angle), radius * std::sin(angle));
    double nearest[2] = {1e9, 1e9};
    for (Index m = 0; m < 2; ++m)
      for (const Face& edge : mesh.topology->markers()[static_cast<std::size_t>(m)].faces) {
        const auto [a, b] = edge.edge();
        const Vec2 s = mesh.coordinates.xy(a);
        const Vec2 d = mesh.coordinates.xy(b) - s;
        const double t = std::clamp((p - s).dot(d) / d.squaredNorm(), 0.0, 1.0);
        nearest[m] = std::min(nearest[m], (p - s - t * d).norm());
      }
    const auto hit = index.pick(p, 10);
    REQUIRE(hit.has_value());
    CHECK(hit->marker == (nearest[flap] < nearest[1 - flap] ? flap : 1 - flap));
  }
}

}  // namespace winslow::gui::test

namespace winslow::gui {

TEST_CASE("an arc grows the shorter way round, over the end of the list too") {
  const BoundaryArc one{0, 2, 2};
  CHECK(extended(one, 5, 20) == BoundaryArc{0, 2, 5});
  CHECK(extended(one, 18, 20) == BoundaryArc{0, 18, 2});
  const BoundaryArc over = extended(one, 18, 20);
  for (const std::size_t inside : {18u, 19u, 0u, 1u, 2u}) CHECK(over.contains(inside));
  for (const std::size_t outside : {3u, 10u, 17u}) CHECK_FALSE(over.contains(outside));
  CHECK(extended(over, 19, 20) == over);
  CHECK(extended(over, 16, 20) == BoundaryArc{0, 16, 2});
  CHECK(extended(over, 4, 20) == BoundaryArc{0, 18, 4});
}

}  // namespace winslow::gui
