#include "gui/picture/capture/between_frames.h"

#include <doctest/doctest.h>

#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("between two meshes of a turn there is one for every degree, valid, the body exact") {
  Rig rig;
  rig.open(ring_mesh(48, 12));
  const Mesh before = rig.mesh();
  turn_flap(rig, 12);
  const Mesh after = rig.mesh();
  const auto nodes = before.topology->markers().nodes(rig.marker("flap"));
  const auto between =
      meshes_between(*before.topology, nodes, before.coordinates, after.coordinates);
  REQUIRE(between.size() == 11);
  for (std::size_t k = 0; k < between.size(); ++k) {
    INFO("mesh ", k);
    CHECK(check_validity(*before.topology, between[k]).inverted == 0);
    const RigidMotion turn{static_cast<double>(k + 1), Vec2(0, 0), Vec2(0, 0)};
    for (const Index node : nodes)
      CHECK((between[k].xy(node) - transform(turn, before.coordinates.xy(node))).norm() < 1e-9);
    for (const Index node : before.topology->markers().nodes(rig.marker("farfield")))
      CHECK(between[k].xy(node) == before.coordinates.xy(node));
  }
}

TEST_CASE("between meshes of a shift there is one for every 2 % of the body; of no motion none") {
  const Mesh mesh = ring_mesh();
  const auto nodes = mesh.topology->markers().nodes(*mesh.topology->markers().find("flap"));
  const double extent = bounds(mesh.coordinates, nodes).size().norm();
  Coordinates to = mesh.coordinates;
  for (const Index node : nodes) to.set_xy(node, to.xy(node) + Vec2(0.1 * extent, 0));
  CHECK(meshes_between(*mesh.topology, nodes, mesh.coordinates, to).size() == 4);
  CHECK(meshes_between(*mesh.topology, nodes, mesh.coordinates, mesh.coordinates).empty());
  CHECK(meshes_between(*mesh.topology, {}, mesh.coordinates, to).empty());
}

TEST_CASE("what would be invalid on the way is left out") {
  const Mesh mesh = ring_mesh();
  const auto nodes = mesh.topology->markers().nodes(*mesh.topology->markers().find("flap"));
  // Turned upside down without the mesh: nothing in between is valid.
  Coordinates to = mesh.coordinates;
  for (const Index node : nodes)
    to.set_xy(node, transform({170, Vec2(0, 0), Vec2(0, 0)}, to.xy(node)));
  for (const Coordinates& x : meshes_between(*mesh.topology, nodes, mesh.coordinates, to))
    CHECK(check_validity(*mesh.topology, x).inverted == 0);
}

}  // namespace winslow::gui::test
