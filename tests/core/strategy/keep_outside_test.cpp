#include "core/strategy/keep_outside.h"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>

#include "core/command/command.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState holes() { return make_state(make_mesh(square_with_two_holes(20, Cells::mixed))); }

std::string some_hole(const MeshState& state) {
  for (const Marker& marker : state.mesh.topology->markers())
    if (marker.name.starts_with("hole")) return marker.name;
  FAIL("no hole");
  return {};
}

MoveCommand turn(const MeshState& state, double degrees) {
  MoveCommand move;
  move.markers = {some_hole(state)};
  move.motion.rotate = degrees;
  return move;
}

std::vector<Index> nodes_of(const MeshState& state, const std::string& marker) {
  const auto motion =
      make_motion(*state.mesh.topology, state.mesh.coordinates, {marker}, RigidMotion{});
  return {motion->nodes().begin(), motion->nodes().end()};
}

struct Counted {
  int moved_inside = 0, inside = 0, moved_outside = 0, outside = 0;
};

/// Interior nodes, told apart by `inside` of where they were.
template <class Inside>
Counted count(const MeshState& before, const Coordinates& after, Inside inside) {
  Counted counted;
  for (const Index node : before.mesh.topology->interior_nodes()) {
    const Vec2 at = before.mesh.coordinates.xy(node);
    const bool moved = after.xy(node) != at;
    if (inside(at)) {
      ++counted.inside;
      counted.moved_inside += moved;
    } else {
      ++counted.outside;
      counted.moved_outside += moved;
    }
  }
  return counted;
}

void check_kept(const Counted& counted, const SmoothResult& result) {
  CHECK(counted.moved_outside == 0);
  CHECK(counted.outside > 10);
  CHECK(counted.moved_inside > counted.inside / 2);
  CHECK(result.kept_outside == counted.outside);
  CHECK(result.converged);
  CHECK(result.inverted == 0);
}

}  // namespace

TEST_CASE("outside a circle about the body nothing moves") {
  const MeshState state = holes();
  for (const char* formulation : {"variational", "pointwise"}) {
    CAPTURE(formulation);
    MoveCommand move = turn(state, 20);
    move.smooth.formulation = formulation;
    const Bounds body = bounds(state.mesh.coordinates, nodes_of(state, move.markers[0]));
    const Vec2 centre = 0.5 * (body.min + body.max);
    const double radius = 0.5 * body.size().norm() + 0.12;
    move.smooth.keep_outside.radius = radius;
    const CommandResult result = execute(move, state);
    check_kept(count(state, result.state.mesh.coordinates,
                     [&](const Vec2& at) { return (at - centre).norm() <= radius; }),
               result.smooth);
  }
}

TEST_CASE("outside a box nothing moves, whichever corners are given") {
  const MeshState state = holes();
  const Bounds all = bounds(state.mesh);
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  const Vec2 middle = 0.5 * (all.min + all.max);
  smooth.smooth.keep_outside.corner = Vec2(middle.x(), all.min.y());
  smooth.smooth.keep_outside.opposite = Vec2(all.min.x(), all.max.y());
  const CommandResult result = execute(smooth, state);
  check_kept(count(state, result.state.mesh.coordinates,
                   [&](const Vec2& at) { return at.x() <= middle.x(); }),
             result.smooth);
}

TEST_CASE("a mesh that is started from is kept outside as the state has it") {
  const MeshState state = holes();
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  const CommandResult elsewhere = execute(smooth, state);
  const Bounds all = bounds(state.mesh);
  const double middle = 0.5 * (all.min.x() + all.max.x());
  smooth.smooth.keep_outside.corner = all.min;
  smooth.smooth.keep_outside.opposite = Vec2(middle, all.max.y());
  RunOptions run;
  run.start = &elsewhere.state.mesh.coordinates;
  const CommandResult result = execute(smooth, state, run);
  check_kept(
      count(state, result.state.mesh.coordinates, [&](const Vec2& at) { return at.x() <= middle; }),
      result.smooth);
}

TEST_CASE("a region far from the origin is the same region") {
  MeshData data = square_with_two_holes(20, Cells::mixed);
  const Vec2 away(1e7, -3e7);
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + away);
  const MeshState state = make_state(make_mesh(data));
  const Bounds all = bounds(state.mesh);
  const double middle = 0.5 * (all.min.x() + all.max.x());
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  smooth.smooth.keep_outside.corner = all.min;
  smooth.smooth.keep_outside.opposite = Vec2(middle, all.max.y());
  const CommandResult result = execute(smooth, state);
  check_kept(
      count(state, result.state.mesh.coordinates, [&](const Vec2& at) { return at.x() <= middle; }),
      result.smooth);
}

TEST_CASE("a drag keeps what lies outside, too") {
  const MeshState state = holes();
  const std::string hole = some_hole(state);
  const Bounds body = bounds(state.mesh.coordinates, nodes_of(state, hole));
  const Vec2 centre = 0.5 * (body.min + body.max);
  SmoothOptions options;
  const double radius = 0.5 * body.size().norm() + 0.12;
  options.keep_outside.radius = radius;
  DragGrip grip;
  grip.markers = {hole};
  DragSession drag(state, grip, options);
  const RigidMotion motion{15, centre, Vec2(0, 0)};
  drag.to(motion);
  while (!drag.settled() && drag.error().empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    drag.to(motion);
  }
  CHECK(drag.error() == "");
  const DragFrame& frame = drag.to(motion);
  CHECK(same_motion(frame.motion, motion));
  const Counted counted = count(state, frame.coordinates,
                                [&](const Vec2& at) { return (at - centre).norm() <= radius; });
  CHECK(counted.moved_outside == 0);
  CHECK(counted.moved_inside > counted.inside / 2);
}

TEST_CASE("a region that cannot be meant is refused") {
  const MeshState state = holes();
  const auto refused = [&](const KeepOutside& keep, Command command) {
    smooth_options(command)->keep_outside = keep;
    try {
      execute(command, state);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const Command smooth = SmoothCommand{};
  const Command move = turn(state, 5);
  CHECK(refused({.radius = 1.0}, smooth).find("give the centre") != std::string::npos);
  CHECK(refused({.centre = Vec2(0, 0)}, smooth).find("without a radius") != std::string::npos);
  CHECK(refused({.corner = Vec2(0, 0)}, smooth).find("expected both") != std::string::npos);
  CHECK(refused({.radius = 1e-3}, move).find("lie outside the region") != std::string::npos);
  CHECK(refused({.radius = -1.0}, move).find("radius") != std::string::npos);
  CHECK(refused({.corner = Vec2(100, 100), .opposite = Vec2(101, 101)}, smooth)
            .find("no interior node") != std::string::npos);
}
