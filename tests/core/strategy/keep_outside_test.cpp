#include "core/strategy/keep_outside.h"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "core/command/command.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

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
  const MeshState state = make_state(shaken_box(6, 0.2, 4));
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
  CHECK(counted.moved_inside > counted.inside / 2);
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
