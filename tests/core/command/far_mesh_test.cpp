#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

/// Commands on a mesh far from the origin do what they do near it.
namespace winslow::test {

namespace {

constexpr double ulp = 0x1p-28;  // of coordinates around 3e7

const Vec2 away(1e7, -3e7);

/// The same mesh near the origin and far from it, with the same coordinates in binary: what the
/// shift rounds off is taken off the near one as well.
struct Pair {
  MeshState near, far;
};

Pair pair_of(MeshData data) {
  MeshData far = data;
  for (Index i = 0; i < data.node_count(); ++i) {
    far.coordinates.set_xy(i, data.coordinates.xy(i) + away);
    data.coordinates.set_xy(i, far.coordinates.xy(i) - away);
  }
  return {make_state(make_mesh(data)), make_state(make_mesh(far))};
}

MeshData holes() { return square_with_two_holes(20, Cells::mixed); }

double largest_difference(const Coordinates& near, const Coordinates& far) {
  REQUIRE(near.size() == far.size());
  double largest = 0;
  for (Index i = 0; i < near.size(); ++i)
    largest = std::max(largest, (far.xy(i) - away - near.xy(i)).lpNorm<Eigen::Infinity>());
  return largest;
}

void check_same(const Command& near, const Command& far, MeshData data) {
  const Pair states = pair_of(std::move(data));
  const CommandResult a = execute(near, states.near);
  const CommandResult b = execute(far, states.far);
  CHECK(b.smooth.converged == a.smooth.converged);
  CHECK(b.smooth.outer_iterations == a.smooth.outer_iterations);
  CHECK(b.smooth.linear_solves == a.smooth.linear_solves);
  CHECK(b.smooth.fraction_reached == a.smooth.fraction_reached);
  CHECK(b.smooth.inverted == a.smooth.inverted);
  CHECK(largest_difference(a.state.mesh.coordinates, b.state.mesh.coordinates) < 2 * ulp);
  const Topology& topology = *states.far.mesh.topology;
  if (!markers_of(near).empty()) return;
  for (Index i = 0; i < topology.node_count(); ++i) {
    if (topology.on_boundary(i))
      CHECK(b.state.mesh.coordinates.xy(i) == states.far.mesh.coordinates.xy(i));
  }
}

void check_same(const Command& command, MeshData data) {
  check_same(command, command, std::move(data));
}

}  // namespace

TEST_CASE("far away: smoothing, by either formulation") {
  SmoothCommand command;
  check_same(command, holes());
  command.smooth.formulation = "pointwise";
  command.smooth.outer = OuterMethod::picard;
  check_same(command, holes());
}

TEST_CASE("far away: motions, about the bodies' centre and about a named pivot") {
  MoveCommand near;
  near.markers = {"hole_a"};
  near.motion.rotate = 40;  // about the centre
  near.motion.translate = Vec2(0.05, 0.1);
  check_same(near, holes());
  MoveCommand far = near;
  near.motion.pivot = Vec2(0.5, 0.25);
  far.motion.pivot = away + Vec2(0.5, 0.25);
  check_same(near, far, holes());
}

TEST_CASE("far away: deformations, of the whole body and of nodes by their place") {
  DeformCommand sine;
  sine.markers = {"hole_b"};
  sine.shape = SineDeformation{0.04, 1.5};
  check_same(sine, holes());
  DeformCommand near = sine, far = sine;
  const Vec2 corner(0.6, 0.4);
  near.shape = DisplacementTable{{{std::nullopt, corner, Vec2(0.02, -0.03), 7}}, "d.csv"};
  far.shape = DisplacementTable{{{std::nullopt, away + corner, Vec2(0.02, -0.03), 7}}, "d.csv"};
  check_same(near, far, holes());
  // A place that is none is named as the user wrote it.
  std::get<DisplacementTable>(far.shape).entries[0].position = away;
  try {
    execute(far, pair_of(holes()).far);
    FAIL("expected UsageError");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find("d.csv:7: position (10000000") == 0);
  }
}

TEST_CASE("far away: layers, at a part of a wall that a box names") {
  LayersCommand near;
  LayerWall wall;
  wall.markers = {"hole_a"};
  wall.spacing.count = 4;
  wall.spacing.first = 0.002;
  wall.part.xmax = 0.31;
  near.layers.walls = {wall};
  LayersCommand far = near;
  far.layers.walls[0].part.xmax += away.x();
  check_same(near, far, square_with_two_holes(20, Cells::triangles));
}

TEST_CASE("far away: the meshes on the way are shown where the mesh is") {
  class Watch final : public SolverMonitor {
   public:
    bool on_iteration(const IterationRecord&, const Coordinates& x) override {
      CHECK((x.xy(0) - away).norm() < 2);
      ++seen;
      return true;
    }
    int seen = 0;
  };
  const Pair states = pair_of(holes());
  Watch watch;
  RunOptions options;
  options.monitor = &watch;
  // The start is given where the mesh is, too.
  const Coordinates start = states.far.mesh.coordinates;
  options.start = &start;
  MoveCommand command;
  command.markers = {"hole_a"};
  command.motion.rotate = 20;
  const CommandResult result = execute(command, states.far, options);
  CHECK(result.smooth.converged);
  CHECK(watch.seen > 0);
}

}  // namespace winslow::test
