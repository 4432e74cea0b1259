#include "core/drag/drag_session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState annulus_state(Cells cells = Cells::triangles, Index rings = 12) {
  return make_state(make_mesh(annulus(32, rings, 1.2, cells)));
}

Index inverted(const MeshState& state, const Coordinates& x) {
  return check_validity(*state.mesh.topology, x, 1).inverted;
}

/// Waits as long as no healthy run needs.
bool wait_until(const std::function<bool()>& done) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < limit) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("a drag ends at the mesh that the command gives") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const MeshState state = annulus_state(cells);
    DragSession drag(state, {"inner"}, {});
    MoveCommand command;
    command.markers = {"inner"};
    for (int k = 1; k <= 20; ++k) {
      command.motion = {4.0 * k, Vec2(0.1, 0), Vec2(0.02 * k, 0.01 * k)};
      const DragFrame& frame = drag.to(command.motion);
      CHECK(inverted(state, frame.coordinates) == 0);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(wait_until([&] {
      drag.to(command.motion);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(command.motion);
    CHECK_FALSE(frame.held);
    CHECK(same_motion(frame.motion, command.motion));
    CHECK(largest_difference(frame.coordinates, execute(command, state).state.mesh.coordinates) <
          1e-8);
    CHECK(drag.corrections() >= 2);
    CHECK(drag.error().empty());
  }
}

TEST_CASE("by the paper's operator a drag ends at that operator's mesh") {
  const MeshState state = annulus_state();
  MoveCommand command;
  command.markers = {"inner"};
  command.motion = {30, Vec2(0, 0), Vec2(0.2, 0)};
  command.smooth.formulation = "pointwise";
  DragSession drag(state, {"inner"}, command.smooth);
  REQUIRE(wait_until([&] {
    const DragFrame& frame = drag.to(command.motion);
    CHECK(inverted(state, frame.coordinates) == 0);
    return drag.settled() && !frame.held;
  }));
  const Coordinates there = drag.to(command.motion).coordinates;
  CHECK(largest_difference(there, execute(command, state).state.mesh.coordinates) < 1e-7);
  // To first order the frames go on from there as the operator's own solution does.
  const double step = 1e-3;
  command.motion.translate.x() += step;
  const Coordinates next = drag.to(command.motion).coordinates;
  CHECK(largest_difference(next, execute(command, state).state.mesh.coordinates) < 0.02 * step);
}

TEST_CASE("a frame that would invert an element is held at the last valid position") {
  const MeshState state = annulus_state();
  DragSession drag(state, {"inner"}, {});
  REQUIRE(wait_until([&] { return drag.ready(); }));
  const RigidMotion easy{0, Vec2(0, 0), Vec2(0.3, 0)};
  CHECK_FALSE(drag.to(easy).held);
  const Coordinates last = drag.to(easy).coordinates;
  // Beyond the outer circle: no mesh is valid there.
  const RigidMotion outside{0, Vec2(0, 0), Vec2(50, 0)};
  CHECK(drag.to(outside).held);
  CHECK(inverted(state, drag.to(outside).coordinates) == 0);
  CHECK(same_motion(drag.to(outside).motion, easy));
  CHECK(drag.to(outside).coordinates == last);
  // It comes back from there.
  REQUIRE(wait_until([&] { return !drag.to(easy).held && drag.settled(); }));
  CHECK(drag.error().empty());
}

TEST_CASE("turning on and on winds the mesh up, and back") {
  const MeshState state = annulus_state(Cells::triangles, 24);
  DragSession drag(state, {"inner"}, {});
  const auto turn_to = [&](double degrees) {
    const RigidMotion motion{degrees, Vec2(0, 0), Vec2(0, 0)};
    return wait_until([&] {
      const DragFrame& frame = drag.to(motion);
      CHECK(inverted(state, frame.coordinates) == 0);
      return drag.settled() && !frame.held;
    });
  };
  REQUIRE(turn_to(0));
  const Coordinates flat = drag.to({}).coordinates;
  REQUIRE(turn_to(200));  // at once, and still not the shorter way round
  const Coordinates wound = drag.to(RigidMotion{200, Vec2(0, 0), Vec2(0, 0)}).coordinates;
  MoveCommand command;
  command.markers = {"inner"};
  command.motion.rotate = 200;
  CHECK(largest_difference(wound, execute(command, state).state.mesh.coordinates) < 1e-7);
  REQUIRE(turn_to(0));
  CHECK(largest_difference(drag.to({}).coordinates, flat) < 1e-7);
}

TEST_CASE("a drag that cannot begin says why; one that is under way can be dropped at any time") {
  MeshState state = annulus_state();
  CHECK_THROWS_AS(DragSession(state, {"wing"}, {}), UsageError);
  SmoothOptions bad;
  bad.damping = 7;
  CHECK_THROWS_AS(DragSession(state, {"inner"}, bad), UsageError);
  for (int k = 0; k < 6; ++k) {
    DragSession drag(state, {"inner"}, {});
    drag.to(RigidMotion{30.0 * k, Vec2(0, 0), Vec2(0, 0)});
    std::this_thread::sleep_for(std::chrono::milliseconds(k));
  }
  Random random(1);
  tangle(state.mesh, random);
  CHECK_THROWS_AS(DragSession(state, {"inner"}, {}), UsageError);
}
