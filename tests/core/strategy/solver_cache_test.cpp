#include "core/strategy/solver_cache.h"

#include <doctest/doctest.h>

#include <utility>

#include "core/command/command.h"
#include "core/error.h"
#include "core/strategy/workspace.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState plane_state(Cells cells = Cells::triangles) {
  return make_state(make_mesh(square_with_hole(15, cells)));
}

MeshState space_state() { return make_state(box_with_body(5, Volumes::tetrahedra)); }

MoveCommand turn(const MeshState& state, double degrees) {
  MoveCommand command;
  const bool space = state.mesh.topology->cell_dimension() == 3;
  command.bodies[0].markers = {space ? "body" : "hole"};
  command.bodies[0].motion.rotate = degrees;
  if (space) command.bodies[0].motion.axis = Vec3(0, 0, 1);
  return command;
}

RunOptions with(SolverCache& cache) {
  RunOptions options;
  options.cache = &cache;
  return options;
}

/// Cancels in its third iteration.
class Impatient final : public SolverMonitor {
 public:
  bool on_iteration(const IterationRecord&, const Coordinates&) override { return ++seen_ < 3; }

 private:
  int seen_ = 0;
};

}  // namespace

TEST_CASE("turn after turn a cache changes no bit of the meshes, in the plane and in space") {
  for (const MeshState& start : {plane_state(), space_state()}) {
    SolverCache cache;
    MeshState kept = start, fresh = start;
    for (const double degrees : {4.0, 6.0, -3.0}) {
      kept = execute(turn(start, degrees), kept, with(cache)).state;
      fresh = execute(turn(start, degrees), fresh).state;
      CHECK(kept.mesh.coordinates == fresh.mesh.coordinates);
    }
  }
}

TEST_CASE("one cache serves meshes in turn, of either dimension") {
  SolverCache cache;
  const MeshState states[] = {plane_state(), space_state(), plane_state(Cells::quads)};
  for (int round = 0; round < 2; ++round) {
    for (const MeshState& state : states) {
      const CommandResult kept = execute(turn(state, 5), state, with(cache));
      CHECK(kept.smooth.converged);
      CHECK(kept.state.mesh.coordinates == execute(turn(state, 5), state).state.mesh.coordinates);
    }
  }
}

TEST_CASE("a cache outlives a topology that is gone, and a command that makes another") {
  SolverCache cache;
  { execute(turn(plane_state(), 5), plane_state(), with(cache)); }
  MeshState state = plane_state();
  LayersCommand layers;
  layers.layers.walls = {{{"hole"}, {.count = 3, .first = 0.005}}};
  const CommandResult kept = execute(layers, state, with(cache));
  CHECK(kept.state.mesh.topology->element_count() > state.mesh.topology->element_count());
  CHECK(kept.state.mesh.coordinates == execute(layers, state).state.mesh.coordinates);
  const CommandResult turned = execute(turn(kept.state, 3), kept.state, with(cache));
  CHECK(turned.state.mesh.coordinates ==
        execute(turn(kept.state, 3), kept.state).state.mesh.coordinates);
}

TEST_CASE("a call that is cancelled or refused leaves a cache that can be used again") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    SolverCache cache;
    Impatient monitor;
    RunOptions options = with(cache);
    options.monitor = &monitor;
    CHECK_THROWS_AS(execute(turn(state, 40), state, options), Cancelled);
    MoveCommand unknown = turn(state, 5);
    unknown.bodies[0].markers = {"nowhere"};
    CHECK_THROWS_AS(execute(unknown, state, with(cache)), UsageError);
    CHECK(execute(turn(state, 5), state, with(cache)).state.mesh.coordinates ==
          execute(turn(state, 5), state).state.mesh.coordinates);
  }
}

TEST_CASE("a cache keeps what it has where it is moved to; clear() gives up all that it holds") {
  const MeshState state = plane_state();
  SolverCache cache;
  const long before = state.mesh.topology.use_count();
  execute(turn(state, 5), state, with(cache));
  CHECK(state.mesh.topology.use_count() > before);
  SmoothingWorkspace* const inside = &cache.workspace();
  SolverCache other = std::move(cache);
  CHECK(&other.workspace() == inside);
  other.clear();
  CHECK(state.mesh.topology.use_count() == before);
  CHECK(execute(turn(state, 5), state, with(other)).smooth.converged);
  CHECK(execute(turn(state, 5), state, with(cache)).smooth.converged);
}
