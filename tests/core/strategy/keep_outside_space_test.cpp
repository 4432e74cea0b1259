#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "core/command/command.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/strategy/keep_outside.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A box with a body in its middle, shifted by `away`.
MeshState box_state(const Vec3& away = Vec3(0, 0, 0)) {
  Mesh mesh = box_with_body(6, Volumes::tetrahedra);
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    mesh.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + away);
  return make_state(std::move(mesh));
}

Box<3> body_of(const MeshState& state) {
  return space_bounds(state.mesh.coordinates,
                      state.mesh.topology->markers().nodes_of(std::vector<std::string>{"body"}));
}

MoveCommand turned_body(double degrees) {
  MoveCommand move;
  move.markers = {"body"};
  move.motion.rotate = degrees;
  move.motion.axis = Vec3::UnitZ();
  return move;
}

struct SpaceCounts {
  int moved_inside = 0, inside = 0, moved_outside = 0, outside = 0;
};
/// Interior nodes, told apart by `inside` of where they were.
template <class Inside>
SpaceCounts count_in_space(const MeshState& before, const Coordinates& after, Inside inside) {
  SpaceCounts counted;
  for (const Index node : before.mesh.topology->interior_nodes()) {
    const Vec3 at = before.mesh.coordinates.xyz(node);
    const bool moved = after.xyz(node) != at;
    (inside(at) ? counted.inside : counted.outside) += 1;
    (inside(at) ? counted.moved_inside : counted.moved_outside) += moved;
  }
  return counted;
}

void check_kept_in_space(const SpaceCounts& counted) {
  CHECK(counted.moved_outside == 0);
  CHECK(counted.outside > 10);
  CHECK(counted.moved_inside > counted.inside / 2);
}

}  // namespace

TEST_CASE("outside a sphere about the body of a volume mesh nothing moves") {
  for (const Vec3& away : {Vec3(0, 0, 0), Vec3(1e6, -3e6, 2e6)}) {
    const MeshState state = box_state(away);
    const Vec3 centre = body_centre(body_of(state));
    const double radius = body_of(state).size().norm();
    for (const bool named : {false, true}) {
      CAPTURE(named);
      MoveCommand move = turned_body(20);
      KeepOutside& keep = move.smooth.keep_outside;
      keep.radius = radius;
      if (named) {
        keep.centre = centre.head<2>();
        keep.centre_z = centre.z();
      }
      const CommandResult result = execute(move, state);
      CHECK(result.smooth.inverted == 0);
      const SpaceCounts counted =
          count_in_space(state, result.state.mesh.coordinates,
                         [&](const Vec3& at) { return (at - centre).norm() <= radius; });
      check_kept_in_space(counted);
      CHECK(result.smooth.kept_outside == counted.outside);
    }
  }
}

TEST_CASE("outside a box of space nothing moves, whichever corners are given") {
  const MeshState state = box_state();
  const Box<3> all = space_bounds(state.mesh);
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  KeepOutside& keep = smooth.smooth.keep_outside;
  const double middle = all.centre().z();
  keep.corner = Vec2(all.min.x(), all.max.y());
  keep.corner_z = middle;
  keep.opposite = Vec2(all.max.x(), all.min.y());
  keep.opposite_z = all.min.z();
  const CommandResult result = execute(smooth, state);
  const SpaceCounts counted = count_in_space(state, result.state.mesh.coordinates,
                                             [&](const Vec3& at) { return at.z() <= middle; });
  CHECK(counted.moved_outside == 0);
  CHECK(counted.outside > 10);
  CHECK(counted.moved_inside > 0);
}

TEST_CASE("a drag in space keeps what lies outside, too") {
  const MeshState state = box_state();
  const Vec3 centre = body_centre(body_of(state));
  SmoothOptions options;
  const double radius = body_of(state).size().norm();
  options.keep_outside.radius = radius;
  DragGrip grip;
  grip.markers = {"body"};
  SpaceDragSession drag(state, grip, options);
  const SpaceMotion motion = turned_body(10).motion.in_space(centre);
  drag.to(motion);
  while (!drag.settled() && drag.error().empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    drag.to(motion);
  }
  CHECK(drag.error() == "");
  check_kept_in_space(count_in_space(state, drag.to(motion).coordinates, [&](const Vec3& at) {
    return (at - centre).norm() <= radius;
  }));
}

TEST_CASE("places of a region have as many coordinates as the mesh") {
  const auto refused = [](const KeepOutside& keep, const MeshState& state) {
    SmoothCommand smooth;
    smooth.smooth.keep_outside = keep;
    try {
      execute(smooth, state);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const MeshState space = box_state();
  const MeshState plane = make_state(make_mesh(square(4, Cells::triangles)));
  CHECK(refused({.radius = 1, .centre = Vec2(0, 0)}, space) ==
        "keep-outside centre: found two numbers, expected three for a volume mesh");
  CHECK(refused({.corner = Vec2(0, 0), .opposite = Vec2(1, 1), .corner_z = 0}, space) ==
        "keep-outside opposite: found two numbers, expected three for a volume mesh");
  CHECK(refused({.radius = 1, .centre = Vec2(0, 0), .centre_z = 0}, plane) ==
        "keep-outside centre: found three numbers, expected two for a plane mesh");
  CHECK(refused({.radius = 1.0}, space).find("centre of the sphere") != std::string::npos);
}
