#include "core/layers/layer_plan.h"

#include <doctest/doctest.h>

#include <numeric>
#include <vector>

#include "core/command/command.h"
#include "core/layers/layer_stack.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Two square holes, 0.2 apart, with layers around both.
MeshState two_bodies() {
  LayersCommand command;
  command.layers.walls.push_back({{"hole_a", "hole_b"}, {6, 0.004, 1.3, 1, {}, false}});
  return execute(command, make_state(make_mesh(square_with_two_holes(40, Cells::triangles)))).state;
}

MeshState shifted(const MeshState& state, double by) {
  MoveCommand move;
  move.bodies[0].markers = {"hole_b"};
  move.bodies[0].motion.translate = Vec2(by, 0);
  const CommandResult result = execute(move, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  // Iterations of all runs are numbered as one.
  for (std::size_t i = 0; i < result.smooth.history.size(); ++i) {
    CHECK(result.smooth.history[i].iteration <= result.smooth.outer_iterations);
    if (i > 0) CHECK(result.smooth.history[i].iteration >= result.smooth.history[i - 1].iteration);
  }
  return result.state;
}

}  // namespace

TEST_CASE("heights made thinner add up; the first stays as long as it can") {
  const std::vector<double> heights{1, 2, 4, 8};
  CHECK(thinned(heights, 20) == heights);
  const auto some = thinned(heights, 9);
  CHECK(sum(some) == doctest::Approx(9).epsilon(1e-12));
  CHECK(some[0] == 1);
  CHECK(some[2] / some[1] == doctest::Approx(some[1] / some[0]).epsilon(1e-12));
  CHECK(thinned(heights, 2) == std::vector<double>(4, 0.5));
  CHECK(thinned(std::vector<double>{4, 2}, 3) == std::vector<double>{2, 1});
}

TEST_CASE(
    "where bodies come near one another layers get thinner, and thick again where they part") {
  const MeshState before = two_bodies();
  const MeshState near = shifted(before, -0.17);  // a gap of 0.03, where the layers are 0.051 thick
  const Coordinates& x = near.mesh.coordinates;
  int facing = 0, away = 0;
  for (std::size_t c = 0; c < near.layers->columns.size(); ++c) {
    const LayerColumn& column = near.layers->columns[c];
    const LayerColumn& earlier = before.layers->columns[c];
    CHECK(column.nodes == earlier.nodes);
    const Vec2 p = x.xy(column.wall_node);
    if (std::abs(p.x() - 0.415) < 0.02 && std::abs(p.y() - 0.5) < 0.09) {
      CHECK(column.thickness() == doctest::Approx(0.35 * 0.03).epsilon(0.01));
      CHECK(column.limit == LayerLimit::clearance);
      CHECK(cut_short(column));
      ++facing;
    } else if (p.x() < 0.25) {
      CHECK(column.heights == earlier.heights);
      CHECK(column.granted.empty());
      ++away;
    }
  }
  CHECK(facing >= 10);
  CHECK(away >= 5);
  CHECK(measure_layers(*near.layers, x).first_error.max < 0.05);

  const MeshState apart = shifted(near, 0.17);
  for (std::size_t c = 0; c < apart.layers->columns.size(); ++c) {
    CHECK(apart.layers->columns[c].heights == before.layers->columns[c].heights);
    CHECK(apart.layers->columns[c].limit == before.layers->columns[c].limit);
    CHECK(apart.layers->columns[c].granted.empty());
  }
  CHECK(measure_layers(*apart.layers, apart.mesh.coordinates).first_error.max < 0.02);
}

TEST_CASE("a motion that leaves room changes no wanted height") {
  const MeshState before = two_bodies();
  const MeshState after = shifted(before, 0.02);
  for (std::size_t c = 0; c < after.layers->columns.size(); ++c) {
    CHECK(after.layers->columns[c].heights == before.layers->columns[c].heights);
  }
}
