#include "core/session/deformer.h"

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

std::vector<MovingBody> turned(const MeshState& state, double degrees) {
  const bool space = state.mesh.topology->cell_dimension() == 3;
  MovingBody body{{space ? "body" : "hole"}, {.rotate = degrees}};
  if (space) body.motion.axis = Vec3(0, 0, 1);
  return {body};
}

CommandResult at(Deformer& deformer, double degrees, double tolerance = 0) {
  deformer.set_motion(turned(deformer.given(), degrees));
  return deformer.step(tolerance);
}

/// From the mesh as given.
CommandResult alone(const MeshState& state, double degrees) {
  MoveCommand command{turned(state, degrees), {}, {}};
  command.smooth.tolerance = 1e-10;
  return execute(command, state);
}

double difference(const MeshState& a, const MeshState& b) {
  return largest_difference(a.mesh.coordinates, b.mesh.coordinates);
}

/// The body as it bends and goes up, at a phase of its oscillation.
struct Oscillation {
  std::vector<Index> nodes;
  Coordinates rest;

  explicit Oscillation(const MeshState& state)
      : nodes(moving_nodes(*state.mesh.topology, turned(state, 0)[0].markers)),
        rest(state.mesh.coordinates) {}
  Coordinates at(double phase) const {
    Coordinates places(rest.dimension(), static_cast<Index>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec3 p = place_of(rest, nodes[k]);
      const double up = 0.04 * std::sin(phase) + 0.03 * std::cos(phase) * p.x() * p.x();
      set_place(places, static_cast<Index>(k), p + Vec3(0, up, 0));
    }
    return places;
  }
};

/// Cancels at once.
class Refusal final : public SolverMonitor {
 public:
  bool on_iteration(const IterationRecord&, const Coordinates&) override { return false; }
};

}  // namespace

TEST_CASE("the mesh of a place is the same whatever way led there, in the plane and in space") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    Deformer deformer(state);
    for (const double degrees : {3.0, 8.0, -4.0, 3.0, 40.0, 3.0}) {
      const CommandResult result = at(deformer, degrees);
      CHECK(result.smooth.converged);
      CHECK(result.smooth.fraction_reached == 1);
      CHECK(difference(result.state, alone(state, degrees).state) < 1e-9);
      CHECK(*deformer.coordinates() == result.state.mesh.coordinates);
    }
    CHECK(deformer.given().mesh.coordinates == state.mesh.coordinates);
  }
}

TEST_CASE("a boundary by its places gives the mesh of a table, and that of the same motion") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    const Oscillation body(state);
    Deformer deformer(state);
    for (const double phase : {0.3, 0.6, 0.9}) {
      deformer.set_boundary(body.nodes, body.at(phase));
      const CommandResult now = deformer.step();
      REQUIRE(now.smooth.fraction_reached == 1);
      DeformCommand command;
      PositionTable table;
      for (std::size_t k = 0; k < body.nodes.size(); ++k)
        table.entries.push_back(
            {body.nodes[k], GivenVector::of(state.mesh.coordinates.dimension(),
                                            place_of(body.at(phase), static_cast<Index>(k)))});
      command.shape = table;
      command.smooth.tolerance = 1e-10;
      CHECK(difference(now.state, execute(command, state).state) < 1e-9);
    }
    // A rigid motion by its places.
    const CommandResult rigid = alone(state, 6);
    Coordinates places(state.mesh.coordinates.dimension(), static_cast<Index>(body.nodes.size()));
    for (std::size_t k = 0; k < body.nodes.size(); ++k)
      set_place(places, static_cast<Index>(k),
                place_of(rigid.state.mesh.coordinates, body.nodes[k]));
    deformer.set_boundary(body.nodes, places);
    CHECK(difference(deformer.step().state, rigid.state) < 1e-8);
  }
}

TEST_CASE("a boundary that oscillates with a loose tolerance does not drift") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    const Oscillation body(state);
    Deformer deformer(state);
    constexpr int steps = 20, periods = 30;
    constexpr double tolerance = 1e-4;
    std::vector<Coordinates> second(steps);
    double drift = 0;
    int solves = 0;
    for (int period = 0; period < periods; ++period)
      for (int step = 0; step < steps; ++step) {
        deformer.set_boundary(body.nodes, body.at(2 * pi * step / steps));
        const CommandResult now = deformer.step(tolerance);
        REQUIRE(now.smooth.inverted == 0);
        REQUIRE(now.smooth.residual <= tolerance);
        solves += now.smooth.linear_solves;
        Coordinates& earlier = second[static_cast<std::size_t>(step)];
        if (period == 1) earlier = now.state.mesh.coordinates;
        if (period == periods - 1)
          drift = std::max(drift, largest_difference(earlier, now.state.mesh.coordinates));
      }
    CAPTURE(drift);
    // As near to the solution in the last period as in the second one: .1 is the length of an edge.
    CHECK(drift < 0.1 * 2 * tolerance);
    CHECK(solves <= 1.2 * steps * periods);
    // And the solution itself is where it was.
    deformer.set_boundary(body.nodes, body.at(1));
    const Coordinates last = deformer.step().state.mesh.coordinates;
    Deformer anew(state);
    anew.set_boundary(body.nodes, body.at(1));
    CHECK(largest_difference(anew.step().state.mesh.coordinates, last) < 1e-8);
  }
}

TEST_CASE("a body that turns on takes the mesh along, and does not jump back after a full turn") {
  const MeshState state = make_state(make_mesh(annulus(24, 10, 1.2, Cells::triangles)));
  Deformer deformer(state);
  constexpr double step = 12;  // degrees
  Coordinates before = state.mesh.coordinates;
  double largest = 0;
  for (double degrees = step; degrees <= 372; degrees += step) {
    deformer.set_motion({{{"inner"}, {.rotate = degrees, .pivot = Vec2(0, 0)}}});
    const CommandResult now = deformer.step(1e-6);
    REQUIRE(now.smooth.fraction_reached == 1);
    REQUIRE(now.smooth.inverted == 0);
    // Beyond that the wound mesh is no longer symmetric.
    if (degrees < 170)
      largest = std::max(largest, largest_difference(before, now.state.mesh.coordinates));
    before = now.state.mesh.coordinates;
  }
  CHECK(largest < 1.3 * 2 * std::sin(radians(step) / 2));
  // The boundary is where it is after a turn by 12 degrees, and the interior is not.
  MoveCommand once;
  once.bodies = {{{"inner"}, {.rotate = step, .pivot = Vec2(0, 0)}}};
  CHECK(largest_difference(execute(once, state).state.mesh.coordinates, before) > 1);
}

TEST_CASE("steps of a motion take fewer linear solves than the way from the mesh as given") {
  const MeshState state = plane_state();
  Deformer deformer(state);
  int steps = 0, commands = 0;
  for (int degrees = 5; degrees <= 40; degrees += 5) {
    steps += at(deformer, degrees).smooth.linear_solves;
    commands += alone(state, degrees).smooth.linear_solves;
  }
  CHECK(steps < commands);
}

TEST_CASE("steps after a restored checkpoint are those after the checkpoint, bit for bit") {
  for (const char* solver : {"direct", "multigrid"}) {
    CAPTURE(solver);
    DeformerOptions options;
    options.smooth.linear.solver = solver;
    Deformer deformer(space_state(), options);
    const auto mesh_at = [&](double degrees) {
      return at(deformer, degrees).state.mesh.coordinates;
    };
    mesh_at(2);
    mesh_at(4);
    const Deformer::Checkpoint checkpoint = deformer.checkpoint();
    const Coordinates there = *deformer.coordinates();
    const Coordinates first = mesh_at(7), second = mesh_at(9);
    for (int repeated = 0; repeated < 2; ++repeated) {
      mesh_at(-3);
      deformer.restore(checkpoint);
      CHECK(*deformer.coordinates() == there);
      CHECK(mesh_at(7) == first);
      CHECK(mesh_at(9) == second);
    }
  }
}

TEST_CASE("a step that is cancelled or refused leaves the last mesh where the next begins") {
  const MeshState state = plane_state();
  Deformer deformer(state), undisturbed(state);
  CHECK_THROWS_AS(deformer.step(), UsageError);  // nothing is set
  CHECK_THROWS_AS(deformer.sensitivity(), UsageError);
  at(deformer, 10);
  at(undisturbed, 10);
  Refusal refusal;
  deformer.set_motion(turned(state, 20));
  CHECK_THROWS_AS(deformer.step(0, &refusal), Cancelled);
  deformer.set_motion({{{"nowhere"}, {.rotate = 5}}});
  CHECK_THROWS_AS(deformer.step(), UsageError);
  CHECK_THROWS_AS(deformer.set_boundary(Oscillation(state).nodes, Coordinates(2, 1)), UsageError);
  CHECK(at(deformer, 15).state.mesh.coordinates == at(undisturbed, 15).state.mesh.coordinates);
}

TEST_CASE(
    "a boundary that no valid mesh has is reached as far as possible, and the session goes on") {
  const MeshState state = plane_state();
  Deformer deformer(state);
  const Coordinates before = at(deformer, 5).state.mesh.coordinates;
  deformer.set_motion({{{"hole"}, {.translate = Vec2(2, 0)}}});  // through the outer boundary
  const CommandResult blocked = deformer.step();
  CHECK(blocked.smooth.fraction_reached < 1);
  CHECK(blocked.smooth.inverted == 0);
  CHECK(!why_incomplete(blocked.smooth).empty());
  CHECK(*deformer.coordinates() == before);
  CHECK(difference(at(deformer, 8).state, alone(state, 8).state) < 1e-9);
}

TEST_CASE("small steps are predicted from the last ones and need about one linear solve each") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    Deformer deformer(state);
    int solves = 0;
    constexpr int steps = 12, first = 4;
    for (int step = 1; step <= steps; ++step) {
      const CommandResult result = at(deformer, 0.1 * step);
      CHECK(result.smooth.converged);
      if (step > first) solves += result.smooth.linear_solves;
    }
    CHECK(solves <= (steps - first) * 5 / 4);
  }
}

TEST_CASE("several bodies go on along their own arcs, and full turns count") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
  Deformer deformer(state);
  for (const double share : {1.0, 1.5, -0.5}) {
    const std::vector<MovingBody> bodies = {
        {{"hole_a"}, {.rotate = 20 * share}},
        {{"hole_b"}, {.rotate = -14 * share, .translate = Vec2(0, 0.02 * share)}}};
    deformer.set_motion(bodies);
    const CommandResult result = deformer.step();
    CHECK(result.smooth.converged);
    CHECK(difference(result.state, execute(MoveCommand{bodies, {}, {}}, state).state) < 1e-9);
  }
}

TEST_CASE("velocities are those of differences of steps, and bound the next step") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    const Oscillation body(state);
    constexpr double phase = 0.7, change = 1e-3;
    const auto mesh_at = [&](double p) {
      Deformer deformer(state);
      deformer.set_boundary(body.nodes, body.at(p));
      return deformer.step(1e-12).state.mesh.coordinates;
    };
    Deformer deformer(state);
    deformer.set_boundary(body.nodes, body.at(phase));
    deformer.step();
    Coordinates boundary(state.mesh.coordinates.dimension(), state.mesh.coordinates.size());
    Coordinates far = *deformer.coordinates();
    const Coordinates now = body.at(phase), next = body.at(phase + change);
    const Coordinates last = body.at(phase - change);
    for (std::size_t k = 0; k < body.nodes.size(); ++k) {
      const auto row = static_cast<Index>(k);
      set_place(boundary, body.nodes[k],
                (place_of(next, row) - place_of(last, row)) / (2 * change));
      set_place(far, body.nodes[k], place_of(now, row) + Vec3(0, 3, 0));
    }
    const Coordinates velocities = deformer.velocities(boundary);
    const Coordinates upper = mesh_at(phase + change), lower = mesh_at(phase - change);
    double off = 0, largest = 0;
    for (std::size_t i = 0; i < upper.values().size(); ++i) {
      const double difference = (upper.values()[i] - lower.values()[i]) / (2 * change);
      off = std::max(off, std::abs(difference - velocities.values()[i]));
      largest = std::max(largest, std::abs(difference));
    }
    CHECK(off < 1e-5 * largest);
    CHECK(deformer.largest_valid(*deformer.coordinates()) == 1);
    const double share = deformer.largest_valid(far);
    CHECK(share > 0);
    CHECK(share < 0.5);
    CHECK_THROWS_AS(deformer.largest_valid(Coordinates(2, 3)), UsageError);
  }
}

TEST_CASE("derivatives of a session are those of single runs, and change no later step") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    Deformer deformer(state), other(state);
    const MeshState moved = at(deformer, 6).state;
    at(other, 6);
    MoveCommand command{turned(state, 6), {}, {}};
    command = std::get<MoveCommand>(with_pivot(command, std::array{&state}));
    const Coordinates velocities =
        parameter_velocities(moved.mesh, command.bodies[0], MotionParameter::rotate);
    const auto kept = deformer.sensitivity();
    const Coordinates product = kept->forward(velocities);
    CHECK(difference(at(deformer, 8).state, at(other, 8).state) == 0);
    CHECK(difference(at(deformer, 3).state, at(other, 3).state) == 0);
    CHECK(largest_difference(kept->forward(velocities), product) == 0);
    const MeshSensitivity of_single(state, MoveCommand{turned(state, 6), {}, {}},
                                    moved.mesh.coordinates);
    CHECK(largest_difference(of_single.forward(velocities), product) < 1e-9);
    CHECK(largest_difference(product, Coordinates(product.dimension(), product.size())) > 1e-3);
  }
}

TEST_CASE("a boundary that returns to rest gives the mesh as given") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    Deformer deformer(state);
    at(deformer, 10);
    at(deformer, 3);
    CHECK(at(deformer, 0).state.mesh.coordinates == state.mesh.coordinates);
    CHECK(difference(at(deformer, 10).state, alone(state, 10).state) < 1e-8);
  }
}
