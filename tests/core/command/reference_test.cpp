#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/command/history.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"
#include "support/wait.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<MeshState> samples() {
  std::vector<MeshState> states;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    Mesh mesh = make_mesh(square_with_hole(15, cells));
    Random random(3);
    perturb(mesh, random, 0.3);
    states.push_back(make_state(std::move(mesh)));
  }
  for (const Volumes volumes : all_volumes) states.push_back(make_state(box_with_body(5, volumes)));
  return states;
}

std::string body_of(const MeshState& state) {
  return state.mesh.topology->cell_dimension() == 3 ? "body" : "hole";
}

MoveCommand turn(const MeshState& state, double degrees) {
  MoveCommand command;
  command.bodies[0].markers = {body_of(state)};
  command.bodies[0].motion.rotate = degrees;
  if (state.mesh.topology->cell_dimension() == 3) command.bodies[0].motion.axis = Vec3(0, 0, 1);
  command.bodies[0].motion.pivot = Vec2(0.5, 0.5);
  if (state.mesh.topology->cell_dimension() == 3)
    command.bodies[0].motion.pivot = GivenVector::of_three(Vec3(0.5, 0.5, 0.5));
  command.smooth.tolerance = 1e-10;
  return command;
}

double difference(const MeshState& a, const MeshState& b) {
  return largest_difference(a.mesh.coordinates, b.mesh.coordinates);
}

MeshState after(const Command& command, const MeshState& state) {
  CommandResult result = execute(command, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  return std::move(result.state);
}

/// Moves every node by a fade of a wave along the body.
DeformCommand bend(const MeshState& state, double amplitude) {
  DeformCommand command;
  command.markers = {body_of(state)};
  SineDeformation sine;
  sine.amplitude = amplitude;
  command.shape = sine;
  return command;
}

}  // namespace

TEST_CASE("no motion is no change, bit for bit, with every option") {
  for (const MeshState& state : samples()) {
    CAPTURE(state.mesh.coordinates.dimension());
    std::vector<Command> commands{turn(state, 0), bend(state, 0)};
    MoveCommand other = turn(state, 0);
    other.smooth.targets = TargetBlend::regular();
    other.smooth.raise_worst = true;
    commands.push_back(other);
    other = turn(state, 0);
    other.how.increments = 3;
    other.smooth.targets = TargetBlend::automatically();
    commands.push_back(other);
    for (const Command& command : commands) {
      const CommandResult result = execute(command, state);
      CHECK(result.smooth.nothing_moves);
      CHECK(result.smooth.converged);
      CHECK(result.smooth.linear_solves == 0);
      CHECK(result.state.mesh.coordinates == state.mesh.coordinates);
    }
    // A full turn moves.
    CHECK_FALSE(execute(turn(state, 360), state).smooth.nothing_moves);
  }
  MoveCommand wrong = turn(samples()[0], 0);
  wrong.bodies[0].markers = {"nobody"};
  CHECK_THROWS_AS(execute(wrong, samples()[0]), UsageError);
}

TEST_CASE("small motions have small effects, and there and back is the mesh as given") {
  for (const MeshState& state : samples()) {
    CAPTURE(state.mesh.coordinates.dimension());
    const double small = difference(after(turn(state, 1e-6), state), state);
    CHECK(small > 0);
    CHECK(small < 1e-7);
    const MeshState there = after(turn(state, 12), state);
    CHECK(difference(there, state) > 1e-3);
    CHECK(difference(after(turn(there, -12), there), state) < 1e-9);
  }
}

TEST_CASE("the result depends on the reference mesh, not on how a motion was cut into steps") {
  for (const MeshState& state : samples()) {
    CAPTURE(state.mesh.coordinates.dimension());
    const MeshState once = after(turn(state, 30), state);
    MeshState steps = state;
    for (int k = 0; k < 6; ++k) steps = after(turn(steps, 5), steps);
    CHECK(difference(steps, once) < 1e-8);
    REQUIRE(steps.reference);
    CHECK(*steps.reference == state.mesh.coordinates);
    // Without a reference mesh each step keeps the shapes of the step before.
    MeshState drifting = state;
    for (int k = 0; k < 6; ++k) {
      drifting = after(turn(drifting, 5), drifting);
      drifting.reference = nullptr;
    }
    CHECK(difference(drifting, once) > 1e-6);
  }
}

TEST_CASE("all of the boundary turned: the mesh is turned rigidly") {
  for (const MeshState& state : samples()) {
    MoveCommand command = turn(state, 30);
    for (const Marker& marker : state.mesh.topology->markers())
      if (marker.name != body_of(state)) command.bodies[0].markers.push_back(marker.name);
    const MeshState turned = after(command, state);
    const RigidMotion motion =
        resolve_motion(command.bodies[0].motion, state.mesh.coordinates.dimension(), Vec3(0, 0, 0));
    double largest = 0;
    for (Index node = 0; node < state.mesh.topology->node_count(); ++node)
      largest = std::max(largest, (transform(motion, place_of(state.mesh.coordinates, node)) -
                                   place_of(turned.mesh.coordinates, node))
                                      .norm());
    CHECK(largest < 1e-11);
  }
}

TEST_CASE("no element ends worse than it was by much, where targets auto would smooth") {
  const MeshState state = samples()[0];
  const auto worst = [](const MeshState& s) {
    return check_validity(*s.mesh.topology, s.mesh.coordinates).min_sine;
  };
  CHECK(worst(after(turn(state, 15), state)) > 0.9 * worst(state));
  MoveCommand automatic = turn(state, 15);
  automatic.smooth.targets = TargetBlend::automatically();
  CHECK(difference(after(automatic, state), after(turn(state, 15), state)) > 1e-3);
}

TEST_CASE("commands that shape the mesh make the next reference mesh; motions carry it along") {
  const MeshState state = samples()[0];
  const MeshState moved = after(turn(state, 5), state);
  REQUIRE(moved.reference);
  CHECK(*moved.reference == state.mesh.coordinates);
  CHECK(execute(turn(moved, 0), moved).state.reference == moved.reference);
  CHECK(execute(ScrambleCommand{}, moved).state.reference == moved.reference);
  CHECK_FALSE(after(SmoothCommand{}, moved).reference);
  // A scrambled mesh finds its shapes again.
  const MeshState scrambled = execute(ScrambleCommand{}, moved).state;
  CHECK(difference(after(turn(scrambled, -5), scrambled), state) < 1e-8);
  // Undo and redo keep it with each mesh.
  History history(state);
  history.push(turn(state, 5), execute(turn(state, 5), state));
  history.undo();
  CHECK_FALSE(history.state().reference);
  history.redo();
  CHECK(*history.state().reference == state.mesh.coordinates);
}

TEST_CASE("a reference mesh from elsewhere must have the connectivity of the mesh") {
  const MeshState state = samples()[0];
  const MeshState moved = after(turn(state, 20), state);
  const MeshState lonely = make_state(moved.mesh);
  const MeshState told = with_reference(lonely, state.mesh);
  CHECK(difference(after(turn(told, -20), told), state) < 1e-9);
  const Mesh other = make_mesh(square_with_hole(15, Cells::quads));
  CHECK_THROWS_AS(with_reference(lonely, other), UsageError);
  CHECK_THROWS_AS(with_reference(lonely, make_mesh(square(15, Cells::triangles))), UsageError);
  CHECK_THROWS_AS(with_reference(lonely, box_with_body(5, Volumes::tetrahedra)), UsageError);
}

TEST_CASE("far from the origin the reference mesh is in the coordinates of the mesh") {
  MeshState state = samples()[0];
  for (double& value : state.mesh.coordinates.values()) value += 4e5;
  MoveCommand command = turn(state, 10);
  command.bodies[0].motion.pivot = Vec2(4e5 + 0.5, 4e5 + 0.5);
  const MeshState there = after(command, state);
  REQUIRE(there.reference);
  CHECK(*there.reference == state.mesh.coordinates);
  command.bodies[0].motion.rotate = -10;
  CHECK(difference(after(command, there), state) < 1e-9);
}

TEST_CASE("a body dragged away and back leaves the mesh as it was, to the bit") {
  const MeshState state = samples()[0];
  DragGrip grip;
  grip.markers = {"hole"};
  SmoothOptions options;
  options.threads = 1;
  DragSession drag(state, grip, options);
  RigidMotion motion;
  motion.rotate = 8;
  motion.pivot = Vec2(0.5, 0.5);
  drag.to(motion);
  wait_until([&] {
    drag.to(motion);
    return drag.settled();
  });
  CHECK_FALSE(drag.to(motion).coordinates == state.mesh.coordinates);
  motion.rotate = 0;
  CHECK(drag.to(motion).coordinates == state.mesh.coordinates);
  CHECK_FALSE(drag.to(motion).held);
}
