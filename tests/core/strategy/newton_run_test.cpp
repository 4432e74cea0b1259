#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/command/command.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState even_annulus_state(Cells cells = Cells::triangles) {
  return make_state(make_mesh(annulus(36, 18, 1 + 6.0 / 36, cells)));
}

/// Rings so close that the pointwise form's own solution, on quadrilaterals, soon is tangled.
MeshState fine_annulus_state() {
  return make_state(make_mesh(annulus(48, 16, 1.125, Cells::quads)));
}

SmoothOptions pointwise(OuterMethod outer) {
  SmoothOptions options;
  options.formulation = Formulation::pointwise;
  options.outer = outer;
  options.threads = 1;
  return options;
}

MoveCommand turn(double degrees, OuterMethod outer) {
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion.rotate = degrees;
  command.smooth = pointwise(outer);
  return command;
}

/// Counts the inverted elements of every mesh on the way by itself.
class Inspector final : public SolverMonitor {
 public:
  explicit Inspector(const Topology& topology) : topology_(topology) {}
  bool on_iteration(const IterationRecord&, const Coordinates& coordinates) override {
    most_inverted = std::max(most_inverted, check_validity(topology_, coordinates).inverted);
    return true;
  }
  Index most_inverted = 0;

 private:
  const Topology& topology_;
};

long count(const SmoothResult& result, Stage stage) {
  return std::count_if(result.history.begin(), result.history.end(),
                       [&](const IterationRecord& record) { return record.stage == stage; });
}

}  // namespace

TEST_CASE("pointwise Newton follows a motion through valid meshes to the fixed point's mesh") {
  for (const Cells cells : {Cells::triangles, Cells::mixed}) {
    for (const double degrees : {20.0, 90.0}) {
      CAPTURE(name_of(cells));
      CAPTURE(degrees);
      const MeshState state = even_annulus_state(cells);
      Inspector inspector(*state.mesh.topology);
      RunOptions watched;
      watched.monitor = &inspector;
      const CommandResult newton = execute(turn(degrees, OuterMethod::newton), state, watched);
      CHECK(newton.smooth.converged);
      CHECK(newton.smooth.fraction_reached == 1);
      CHECK(inspector.most_inverted == 0);
      CHECK(newton.smooth.linear_solves <= 20);
      CHECK(count(newton.smooth, Stage::path) > 0);
      CHECK(count(newton.smooth, Stage::newton) > 0);
      CHECK(count(newton.smooth, Stage::picard) == 0);
      const CommandResult picard = execute(turn(degrees, OuterMethod::picard), state);
      REQUIRE(picard.smooth.converged);
      CHECK(largest_difference(newton.state.mesh.coordinates, picard.state.mesh.coordinates) <
            1e-8);
      // Where Newton gets there, the automatic choice is Newton.
      const CommandResult automatic = execute(turn(degrees, OuterMethod::automatic), state);
      CHECK(automatic.state.mesh.coordinates == newton.state.mesh.coordinates);
      CHECK(automatic.smooth.linear_solves == newton.smooth.linear_solves);
    }
  }
}

TEST_CASE("pointwise Newton in equal steps, and from a start, reaches the same mesh") {
  const MeshState state = even_annulus_state();
  MoveCommand command = turn(30, OuterMethod::newton);
  const Coordinates expected = execute(command, state).state.mesh.coordinates;
  for (const int increments : {1, 3}) {
    CAPTURE(increments);
    command.how.increments = increments;
    const CommandResult stepped = execute(command, state);
    CHECK(stepped.smooth.converged);
    CHECK(stepped.smooth.increments == increments);
    CHECK(largest_difference(stepped.state.mesh.coordinates, expected) < 1e-8);
  }
  command.how.increments = 0;
  const Coordinates near = execute(turn(25, OuterMethod::newton), state).state.mesh.coordinates;
  RunOptions options;
  options.start = &near;
  const CommandResult warm = execute(command, state, options);
  CHECK(warm.smooth.converged);
  CHECK(largest_difference(warm.state.mesh.coordinates, expected) < 1e-8);
}

TEST_CASE("pointwise Newton takes a tangled interior on after the fixed point has untangled it") {
  for (const Cells cells : all_cells) {
    constexpr std::uint64_t seed = 301;
    CAPTURE(name_of(cells));
    CAPTURE(seed);
    MeshState state = even_annulus_state(cells);
    const CommandResult straight = execute(SmoothCommand{pointwise(OuterMethod::picard)}, state);
    REQUIRE(straight.smooth.converged);
    Random random(seed);
    tangle(state.mesh, random);
    for (const OuterMethod outer : {OuterMethod::newton, OuterMethod::automatic}) {
      const CommandResult result = execute(SmoothCommand{pointwise(outer)}, state);
      CHECK(result.smooth.converged);
      CHECK(result.smooth.inverted == 0);
      CHECK(count(result.smooth, Stage::picard) > 0);
      CHECK(result.smooth.history.back().stage == Stage::newton);
      CHECK(largest_difference(result.state.mesh.coordinates, straight.state.mesh.coordinates) <
            1e-8);
    }
  }
}

TEST_CASE("pointwise Newton stops at the last valid mesh where the solution beyond is tangled") {
  const MeshState state = fine_annulus_state();
  const CommandResult picard = execute(turn(60, OuterMethod::picard), state);
  REQUIRE(picard.smooth.inverted > 0);
  Inspector inspector(*state.mesh.topology);
  RunOptions watched;
  watched.monitor = &inspector;
  const CommandResult newton = execute(turn(60, OuterMethod::newton), state, watched);
  CHECK(inspector.most_inverted == 0);
  CHECK(newton.smooth.fraction_reached > 0.5);
  CHECK(newton.smooth.fraction_reached < 1);
  // The last mesh of the path without slivers is taken, whatever was tried from the later ones.
  const auto& history = newton.smooth.history;
  const auto last_on_path =
      std::find_if(history.rbegin(), history.rend(),
                   [](const IterationRecord& record) { return record.stage == Stage::path; });
  REQUIRE(last_on_path != history.rend());
  const auto sine = [](const Mesh& mesh) {
    return check_validity(*mesh.topology, mesh.coordinates).min_sine;
  };
  const double least = 0.1 * sine(state.mesh);
  CHECK(last_on_path->min_sine < least);
  CHECK(last_on_path->fraction > newton.smooth.fraction_reached);
  CHECK(sine(newton.state.mesh) > 0.5 * least);  // the path is near solutions only
  CHECK(newton.smooth.converged);
  // The fixed point is tried, but its tangled mesh is not put above a valid one.
  const CommandResult automatic = execute(turn(60, OuterMethod::automatic), state);
  CHECK(automatic.state.mesh.coordinates == newton.state.mesh.coordinates);
  CHECK(automatic.smooth.fraction_reached == newton.smooth.fraction_reached);
  CHECK(automatic.smooth.residual == newton.smooth.residual);
  CHECK(automatic.smooth.converged == newton.smooth.converged);
  CHECK(automatic.smooth.inverted == 0);
  CHECK(count(automatic.smooth, Stage::picard) > 0);
  CHECK(automatic.smooth.linear_solves > newton.smooth.linear_solves);
}

TEST_CASE("where the path is lost the automatic choice is the fixed point's mesh, if valid") {
  // Turned all the way round, the mesh is wound up too far; the fixed point, which takes the motion
  // at once, has nothing to unwind.
  const MeshState state = fine_annulus_state();
  const CommandResult newton = execute(turn(360, OuterMethod::newton), state);
  CHECK(newton.smooth.fraction_reached < 1);
  CHECK(newton.smooth.inverted == 0);
  const CommandResult picard = execute(turn(360, OuterMethod::picard), state);
  REQUIRE(picard.smooth.converged);
  const CommandResult automatic = execute(turn(360, OuterMethod::automatic), state);
  CHECK(automatic.smooth.converged);
  CHECK(automatic.smooth.fraction_reached == 1);
  CHECK(automatic.state.mesh.coordinates == picard.state.mesh.coordinates);
  CHECK(automatic.smooth.linear_solves ==
        newton.smooth.linear_solves + picard.smooth.linear_solves);
}

TEST_CASE("pointwise Newton keeps the limit of iterations over all of its stages") {
  const MeshState state = even_annulus_state();
  for (const OuterMethod outer : {OuterMethod::newton, OuterMethod::automatic}) {
    for (const int limit : {0, 1, 4}) {
      CAPTURE(limit);
      MoveCommand command = turn(90, outer);
      command.smooth.max_iterations = limit;
      const CommandResult result = execute(command, state);
      CHECK(result.smooth.outer_iterations == limit);
      CHECK_FALSE(result.smooth.converged);
      CHECK(check_validity(*state.mesh.topology, result.state.mesh.coordinates).inverted == 0);
    }
  }
}

TEST_CASE("a cache kept over outer methods and formulations changes no bit of the result") {
  SolverCache cache;
  const MeshState state = even_annulus_state();
  for (int round = 0; round < 2; ++round) {
    for (const OuterMethod outer : {OuterMethod::newton, OuterMethod::picard}) {
      RunOptions options;
      options.cache = &cache;
      const MoveCommand command = turn(40, outer);
      CHECK(execute(command, state, options).state.mesh.coordinates ==
            execute(command, state).state.mesh.coordinates);
      MoveCommand variational = command;
      variational.smooth.formulation = Formulation::variational;
      variational.smooth.outer = OuterMethod::automatic;
      CHECK(execute(variational, state, options).state.mesh.coordinates ==
            execute(variational, state).state.mesh.coordinates);
    }
  }
}
