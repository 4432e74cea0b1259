#include "core/motion/transfer.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("a transfer follows a rigid motion as such and ends exactly at its target") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const RigidMotion whole{130, Vec2(0.3, 0.1), Vec2(0.2, -0.4)};
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, {"inner"}, whole);
  Coordinates to = mesh.coordinates;
  motion->apply(mesh.coordinates, 1, to);
  const auto transfer = make_transfer(NodeClasses(mesh.topology), mesh.coordinates, to);
  CHECK(transfer->nodes().size() == 16);
  Coordinates x = mesh.coordinates;
  transfer->apply(mesh.coordinates, 1, x);
  for (const Index node : transfer->nodes()) CHECK(x.xy(node) == to.xy(node));
  // Half-way the body has its shape and half the angle.
  transfer->apply(mesh.coordinates, 0.5, x);
  const auto nodes = transfer->nodes();
  const Vec2 before = mesh.coordinates.xy(nodes[1]) - mesh.coordinates.xy(nodes[0]);
  const Vec2 after = x.xy(nodes[1]) - x.xy(nodes[0]);
  CHECK(after.norm() == doctest::Approx(before.norm()));
  const double angle =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  CHECK(angle == doctest::Approx(radians(65)));
}

TEST_CASE("a transfer carries a change of shape along") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  Coordinates to = mesh.coordinates;
  const Index marker = *mesh.topology->markers().find("inner");
  for (const Index node : mesh.topology->markers().nodes(marker)) {
    to.set_xy(node, Vec2(1.2 * to.xy(node).x(), 0.9 * to.xy(node).y()));
  }
  const auto transfer = make_transfer(NodeClasses(mesh.topology), mesh.coordinates, to);
  Coordinates x = mesh.coordinates;
  transfer->apply(mesh.coordinates, 0.5, x);
  for (const Index node : transfer->nodes()) {
    const Vec2 middle = 0.5 * (mesh.coordinates.xy(node) + to.xy(node));
    CHECK((x.xy(node) - middle).norm() < 1e-12);
  }
}

TEST_CASE("nothing to do is no motion") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const auto transfer =
      make_transfer(NodeClasses(mesh.topology), mesh.coordinates, mesh.coordinates);
  CHECK(transfer->nodes().empty());
}
