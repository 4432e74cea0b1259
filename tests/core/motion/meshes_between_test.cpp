#include "core/motion/meshes_between.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Mesh ring() { return make_mesh(annulus(48, 12, 1.15, Cells::triangles)); }

std::span<const Index> nodes_of(const Mesh& mesh, const char* marker) {
  const Markers& markers = mesh.topology->markers();
  return markers.nodes(*markers.find(marker));
}

}  // namespace

TEST_CASE("between two meshes of a turn there is one for every degree, valid, the body exact") {
  const Mesh before = ring();
  MoveCommand move;
  move.markers = {"inner"};
  move.motion.rotate = 12;
  const Mesh after = execute(move, make_state(before)).state.mesh;
  const auto nodes = nodes_of(before, "inner");
  const auto between =
      meshes_between(*before.topology, nodes, before.coordinates, after.coordinates);
  REQUIRE(between.size() == 11);
  for (std::size_t k = 0; k < between.size(); ++k) {
    INFO("mesh ", k);
    CHECK(check_validity(*before.topology, between[k]).inverted == 0);
    const RigidMotion turn{static_cast<double>(k + 1), Vec2(0, 0), Vec2(0, 0)};
    for (const Index node : nodes)
      CHECK((between[k].xy(node) - transform(turn, before.coordinates.xy(node))).norm() < 1e-9);
    for (const Index node : nodes_of(before, "outer"))
      CHECK(between[k].xy(node) == before.coordinates.xy(node));
  }
}

TEST_CASE("in space, too: the body turns about its axis, and the box around it stays") {
  const Mesh before = box_with_body(5, Volumes::mixed);
  MoveCommand move;
  move.markers = {"body"};
  move.motion.rotate = 12;
  move.motion.axis = Vec3(1, -1, 0.5);
  const Mesh after = execute(move, make_state(before)).state.mesh;
  const auto nodes = nodes_of(before, "body");
  const auto between =
      meshes_between(*before.topology, nodes, before.coordinates, after.coordinates);
  REQUIRE(between.size() == 11);
  const Vec3 centre = space_bounds(before.coordinates, nodes).centre();
  for (std::size_t k = 0; k < between.size(); ++k) {
    INFO("mesh ", k);
    CHECK(check_validity(*before.topology, between[k]).inverted == 0);
    const SpaceMotion turn{static_cast<double>(k + 1), *move.motion.axis, centre, Vec3::Zero()};
    for (const Index node : nodes)
      CHECK((between[k].xyz(node) - transform(turn, before.coordinates.xyz(node))).norm() < 1e-9);
    for (const Index node : nodes_of(before, "far"))
      CHECK(between[k].xyz(node) == before.coordinates.xyz(node));
  }
}

TEST_CASE("between meshes of a shift there is one for every 2 % of the body; of no motion none") {
  const Mesh mesh = ring();
  const auto nodes = nodes_of(mesh, "inner");
  const double extent = bounds(mesh.coordinates, nodes).size().norm();
  MoveCommand move;
  move.markers = {"inner"};
  move.motion.translate = Vec2(0.1 * extent, 0);
  const Coordinates to = execute(move, make_state(mesh)).state.mesh.coordinates;
  CHECK(meshes_between(*mesh.topology, nodes, mesh.coordinates, to).size() == 4);
  CHECK(meshes_between(*mesh.topology, nodes, mesh.coordinates, mesh.coordinates).empty());
  CHECK(meshes_between(*mesh.topology, {}, mesh.coordinates, to).empty());
}

TEST_CASE("what would be invalid on the way is left out") {
  const Mesh mesh = ring();
  const auto nodes = nodes_of(mesh, "inner");
  // Turned upside down without the mesh: nothing in between is valid but the first few.
  Coordinates to = mesh.coordinates;
  for (const Index node : nodes)
    to.set_xy(node, transform({170, Vec2(0, 0), Vec2(0, 0)}, to.xy(node)));
  const auto between = meshes_between(*mesh.topology, nodes, mesh.coordinates, to);
  CHECK(between.size() < 89);
  for (const Coordinates& x : between) CHECK(check_validity(*mesh.topology, x).inverted == 0);
}
