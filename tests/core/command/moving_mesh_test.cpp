#include "core/command/moving_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState plane_state() { return make_state(make_mesh(square_with_hole(15, Cells::triangles))); }
MeshState space_state() { return make_state(box_with_body(5, Volumes::tetrahedra)); }

MoveCommand turned(const MeshState& state, double degrees) {
  MoveCommand command;
  const bool space = state.mesh.topology->cell_dimension() == 3;
  command.bodies[0].markers = {space ? "body" : "hole"};
  command.bodies[0].motion.rotate = degrees;
  if (space) command.bodies[0].motion.axis = Vec3(0, 0, 1);
  return command;
}

double difference(const MeshState& a, const MeshState& b) {
  return largest_difference(a.mesh.coordinates, b.mesh.coordinates);
}

/// Cancels at once.
class Refusal final : public SolverMonitor {
 public:
  bool on_iteration(const IterationRecord&, const Coordinates&) override { return false; }
};

}  // namespace

TEST_CASE("the mesh of a place is the same whatever way led there, in the plane and in space") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    MovingMesh moving(state);
    for (const double degrees : {3.0, 8.0, -4.0, 3.0}) {
      const CommandResult result = moving.to(turned(state, degrees));
      CHECK(result.smooth.converged);
      CHECK(result.smooth.fraction_reached == 1);
      MoveCommand alone = turned(state, degrees);
      alone.smooth.tolerance = 1e-10;
      CHECK(difference(result.state, execute(alone, state).state) < 1e-9);
    }
    CHECK(moving.given().mesh.coordinates == state.mesh.coordinates);
  }
}

TEST_CASE("steps of a motion take fewer linear solves than the way from the mesh as given") {
  const MeshState state = plane_state();
  MovingMesh moving(state);
  int steps = 0, commands = 0;
  for (int degrees = 5; degrees <= 40; degrees += 5) {
    steps += moving.to(turned(state, degrees)).smooth.linear_solves;
    commands += execute(turned(state, degrees), state).smooth.linear_solves;
  }
  CHECK(steps < commands);
}

TEST_CASE("steps after a restored checkpoint are those after the checkpoint, bit for bit") {
  for (const char* solver : {"direct", "multigrid"}) {
    CAPTURE(solver);
    const MeshState state = space_state();
    MovingMesh moving(state);
    const auto at = [&](double degrees) {
      MoveCommand command = turned(state, degrees);
      command.smooth.linear.solver = solver;
      return moving.to(command).state.mesh.coordinates;
    };
    at(2);
    at(4);
    const MovingMesh::Checkpoint checkpoint = moving.checkpoint();
    const Coordinates first = at(7), second = at(9);
    for (int repeated = 0; repeated < 2; ++repeated) {
      at(-3);
      moving.restore(checkpoint);
      CHECK(at(7) == first);
      CHECK(at(9) == second);
    }
  }
}

TEST_CASE("a call that is cancelled or refused leaves the last mesh where the next begins") {
  const MeshState state = plane_state();
  MovingMesh moving(state), undisturbed(state);
  moving.to(turned(state, 10));
  undisturbed.to(turned(state, 10));
  Refusal refusal;
  RunOptions options;
  options.monitor = &refusal;
  CHECK_THROWS_AS(moving.to(turned(state, 20), options), Cancelled);
  MoveCommand unknown = turned(state, 5);
  unknown.bodies[0].markers = {"nowhere"};
  CHECK_THROWS_AS(moving.to(unknown), UsageError);
  CHECK(moving.to(turned(state, 15)).state.mesh.coordinates ==
        undisturbed.to(turned(state, 15)).state.mesh.coordinates);
}

TEST_CASE("a result of other elements, or one that is not valid, is no place to begin from") {
  const MeshState state = plane_state();
  MovingMesh moving(state);
  moving.to(turned(state, 5));
  LayersCommand layers;
  layers.layers.walls = {{{"hole"}, {.count = 2, .first = 0.005}}};
  const CommandResult layered = moving.to(layers);
  CHECK(layered.state.mesh.topology != state.mesh.topology);
  moving.to(ScrambleCommand{});
  CHECK(difference(moving.to(turned(state, 5)).state, execute(turned(state, 5), state).state) <
        1e-9);
}

TEST_CASE("small steps are predicted from the last ones and need about one linear solve each") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    MovingMesh moving(state);
    int solves = 0;
    constexpr int steps = 12, first = 4;
    for (int step = 1; step <= steps; ++step) {
      const CommandResult result = moving.to(turned(state, 0.1 * step));
      CHECK(result.smooth.converged);
      if (step > first) solves += result.smooth.linear_solves;
    }
    CHECK(solves <= (steps - first) * 5 / 4);
  }
}

TEST_CASE("several bodies go on along their own arcs, and full turns count") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
  MovingMesh moving(state);
  MoveCommand command;
  for (const double share : {1.0, 1.5, -0.5}) {
    command.bodies = {{{"hole_a"}, {.rotate = 20 * share}},
                      {{"hole_b"}, {.rotate = -14 * share, .translate = Vec2(0, 0.02 * share)}}};
    const CommandResult result = moving.to(command);
    CHECK(result.smooth.converged);
    CHECK(difference(result.state, execute(command, state).state) < 1e-9);
  }
}
