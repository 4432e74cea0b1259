#include "core/command/motion_frames.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState ring() { return make_state(make_mesh(annulus(48, 12, 1.15, Cells::triangles))); }

MoveCommand turn(double degrees) {
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = degrees;
  return move;
}

/// Degrees by which the body turns from one mesh to another.
double turned(const Mesh& from, const Mesh& to) {
  const auto nodes = moved_as_bodies(turn(0), *from.topology);
  return fit_rigid_motion(nodes.front(), from.coordinates, to.coordinates).rotate;
}

}  // namespace

TEST_CASE("frames of a turn are no more than a degree apart, and all of them valid") {
  const MeshState start = ring();
  const std::vector<Mesh> frames = motion_frames({turn(60)}, start);
  CHECK(frames.size() > 60);
  CHECK(frames.front().coordinates == start.mesh.coordinates);
  CHECK(frames.back().coordinates == execute(turn(60), start).state.mesh.coordinates);
  double most = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    CHECK(check_validity(*frames[k].topology, frames[k].coordinates).inverted == 0);
    CHECK_FALSE(frames[k].coordinates == frames[k - 1].coordinates);
    most = std::max(most, turned(frames[k - 1], frames[k]));
  }
  CHECK(most < 1 + 1e-6);
}

TEST_CASE("no more frames of a command than asked for, evenly over its way, the result the last") {
  const MeshState start = ring();
  const auto frames = motion_frames({turn(30), turn(-30)}, start, {.per_command = 6});
  REQUIRE(frames.size() == 13);
  for (std::size_t k = 1; k < frames.size(); ++k)
    CHECK(std::abs(turned(frames[k - 1], frames[k])) < 12);
  CHECK(turned(frames[0], frames[6]) == doctest::Approx(30));
  CHECK(std::abs(turned(frames[0], frames[12])) < 1e-6);
}

TEST_CASE("frames of a command that changes the connectivity are of the mesh that they are of") {
  LayersCommand layers;
  layers.layers.walls.push_back({{"inner"}, {4, 0.004, 1.2, 1.0, {}, false}});
  const auto frames = motion_frames({layers, turn(5)}, ring());
  REQUIRE(frames.size() > 6);
  CHECK(frames.front().topology != frames.back().topology);
  for (const Mesh& mesh : frames) CHECK(mesh.topology->node_count() == mesh.coordinates.size());
}

TEST_CASE("frames that are cancelled end at once") {
  int asked = 0;
  CHECK_THROWS_AS(motion_frames({turn(60)}, ring(), {.cancelled = [&] { return ++asked > 1; }}),
                  Cancelled);
  CHECK(asked == 2);
}
