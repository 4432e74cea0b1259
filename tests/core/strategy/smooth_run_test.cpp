#include "core/strategy/smooth_run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/surface_faces.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A motion of any nodes by one displacement.
class Shift final : public Motion {
 public:
  Shift(std::vector<Index> nodes, const Vec2& by) : nodes_(std::move(nodes)), by_(by) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (const Index node : nodes_) out.set_xy(node, rest.xy(node) + fraction * by_);
  }

 private:
  std::vector<Index> nodes_;
  Vec2 by_;
};

struct Way {
  Formulation formulation;
  OuterMethod outer;
};

}  // namespace

TEST_CASE("a motion may take interior nodes: they go where it says and the others make room") {
  for (const Way& way : {Way{Formulation::variational, OuterMethod::newton},
                         Way{Formulation::pointwise, OuterMethod::newton},
                         Way{Formulation::pointwise, OuterMethod::picard}}) {
    CAPTURE(formulation_name(way.formulation));
    const MeshState state = make_state(make_mesh(square(12, Cells::triangles)));
    const Topology& topology = *state.mesh.topology;
    SmoothOptions options;
    options.formulation = way.formulation;
    options.outer = way.outer;
    options.threads = 1;
    Coordinates rest = state.mesh.coordinates;
    REQUIRE(smooth_interior(state, options, rest, {}).converged);

    // The node nearest to the middle and those around it.
    Index middle = topology.interior_nodes()[0];
    for (const Index node : topology.interior_nodes()) {
      const Vec2 centre(0.5, 0.5);
      if ((rest.xy(node) - centre).norm() < (rest.xy(middle) - centre).norm()) middle = node;
    }
    std::vector<Index> patch(topology.neighbours(middle).begin(),
                             topology.neighbours(middle).end());
    patch.push_back(middle);
    const Vec2 by(0.05, -0.03);
    const Shift motion(patch, by);

    MeshState smooth = state;
    smooth.mesh.coordinates = rest;
    Coordinates x = rest;
    const SmoothResult result = smooth_motion(smooth, motion, {}, options, x, {});
    CHECK(result.converged);
    CHECK(result.fraction_reached == 1);
    CHECK(check_validity(topology, x).inverted == 0);
    for (const Index node : patch) CHECK(x.xy(node) == rest.xy(node) + by);
    Index followed = 0;
    for (const Index node : topology.interior_nodes()) {
      if (x.xy(node) != rest.xy(node)) ++followed;
    }
    CHECK(followed == static_cast<Index>(topology.interior_nodes().size()));

    // With nothing prescribed the mesh springs back: the patch was held, not smoothed.
    Coordinates back = x;
    REQUIRE(smooth_interior(smooth, options, back, {}).converged);
    CHECK((back.xy(middle) - rest.xy(middle)).norm() < 1e-6);
  }
}

TEST_CASE("a path ends at the last mesh within the limits, however the limit is set") {
  const MeshState state = make_state(make_mesh(annulus(24, 8, 1.25, Cells::mixed)));
  SmoothOptions options;
  options.threads = 1;
  const auto motion =
      make_motion(*state.mesh.topology, state.mesh.coordinates, std::vector<std::string>{"inner"},
                  RigidMotion{120, Vec2(0, 0), Vec2(0, 0)});
  Coordinates whole = state.mesh.coordinates;
  const SmoothResult all = smooth_motion(state, *motion, {}, options, whole, {});
  REQUIRE(all.fraction_reached == 1);
  REQUIRE(all.limited_by.empty());
  for (const Metric metric :
       {Metric::normalized_jacobian, Metric::smallest_angle, Metric::skewness}) {
    CAPTURE(metric_name(metric));
    const auto worst = [&](const Coordinates& x) {
      const auto values = element_values({state.mesh.topology, x}, metric);
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      return metric_info(metric).field.larger_is_better ? *least : *most;
    };
    Coordinates rest = state.mesh.coordinates;
    smooth_interior(state, options, rest, {});
    const double from = worst(rest), to = worst(whole);
    const double limit = 0.5 * (from + to);
    MotionOptions how;
    how.floor.set(metric, limit);
    Coordinates x = state.mesh.coordinates;
    const SmoothResult result = smooth_motion(state, *motion, how, options, x, {});
    CHECK(result.fraction_reached > 0.05);
    CHECK(result.fraction_reached < 1);
    CHECK_FALSE(result.limited_by.empty());
    CHECK(how.floor.fault({state.mesh.topology, x}, state.mesh.coordinates).empty());
    CHECK(std::abs(worst(x) - limit) < 0.05 * std::abs(from - to));
    // The boundary is where the result says.
    Coordinates there = state.mesh.coordinates;
    motion->apply(state.mesh.coordinates, result.fraction_reached, there);
    for (const Index node : motion->nodes()) CHECK((x.xy(node) - there.xy(node)).norm() < 1e-12);
    // And a little farther it would be beyond the limit.
    MotionOptions farther = how;
    farther.floor = {};
    const auto more =
        make_motion(*state.mesh.topology, state.mesh.coordinates, std::vector<std::string>{"inner"},
                    RigidMotion{120 * (result.fraction_reached + 0.01), Vec2(0, 0), Vec2(0, 0)});
    Coordinates beyond = state.mesh.coordinates;
    smooth_motion(state, *more, farther, options, beyond, {});
    CHECK_FALSE(how.floor.fault({state.mesh.topology, beyond}, state.mesh.coordinates).empty());
  }
}

TEST_CASE("the fixed point does not take over where a limit has ended the path") {
  const MeshState state = make_state(make_mesh(annulus(24, 8, 1.25, Cells::triangles)));
  SmoothOptions options;
  options.formulation = Formulation::pointwise;
  options.threads = 1;
  const auto motion =
      make_motion(*state.mesh.topology, state.mesh.coordinates, std::vector<std::string>{"inner"},
                  RigidMotion{90, Vec2(0, 0), Vec2(0, 0)});
  Coordinates x = state.mesh.coordinates;
  REQUIRE(smooth_motion(state, *motion, {}, options, x, {}).fraction_reached == 1);
  MotionOptions how;
  how.floor.set(Metric::normalized_jacobian,
                check_validity(*state.mesh.topology, x).min_sine + 0.05);
  x = state.mesh.coordinates;
  const SmoothResult result = smooth_motion(state, *motion, how, options, x, {});
  CHECK(result.fraction_reached < 1);
  CHECK(how.floor.fault({state.mesh.topology, x}, state.mesh.coordinates).empty());
}

TEST_CASE("smoothing in place keeps the worst element of the mesh as given") {
  // What a steep penalty has given its worst elements, a gentle one takes away again.
  MoveCommand turn;
  turn.bodies[0].markers = {"hole_a"};
  turn.bodies[0].motion.rotate = 25;
  turn.smooth.targets = TargetBlend::regular();
  turn.smooth.penalty.exponent = 16;
  const MeshState given =
      execute(turn, make_state(make_mesh(square_with_two_holes(16, Cells::triangles)))).state;
  const auto worst_of = [&](const Coordinates& x) {
    return check_validity(*given.mesh.topology, x).min_sine;
  };
  const double worst = worst_of(given.mesh.coordinates);
  SmoothCommand gentle;
  gentle.smooth.penalty = {1, 0};
  Coordinates x = given.mesh.coordinates;
  smooth_interior(given, gentle.smooth, x, {});
  REQUIRE(worst_of(x) < worst - 1e-3);
  const CommandResult kept = execute(gentle, given);
  CHECK(kept.smooth.converged);
  CHECK(worst_of(kept.state.mesh.coordinates) > worst - 1e-5);
}

TEST_CASE("regular targets do not leave the worst element below that of the mesh as given") {
  const MeshState given = make_state(make_mesh(annulus(24, 6, 1.3, Cells::quads)));
  MoveCommand turn;
  turn.bodies[0].markers = {"inner"};
  turn.bodies[0].motion.translate = {1.8, 0};
  turn.smooth.raise_worst = true;
  const MeshState best = execute(turn, given).state;
  const auto worst_of = [&](const Coordinates& x) {
    return check_validity(*best.mesh.topology, x).min_sine;
  };
  const double worst = worst_of(best.mesh.coordinates);
  SmoothCommand regular;
  regular.smooth.targets = TargetBlend::regular();
  regular.smooth.penalty = {1, 0};  // hardly minds the worst elements
  Coordinates x = best.mesh.coordinates;
  const SmoothResult alone = smooth_interior(best, regular.smooth, x, {});
  REQUIRE(alone.converged);
  REQUIRE(worst_of(x) < 0.9 * worst);
  const CommandResult raised = execute(regular, best);
  CHECK(raised.smooth.converged);
  CHECK(raised.smooth.residual == alone.residual);
  CHECK(raised.smooth.history.back().stage == Stage::worst);
  CHECK(raised.smooth.outer_iterations <= alone.outer_iterations + 30);
  CHECK(worst_of(raised.state.mesh.coordinates) > 0.5 * (worst_of(x) + worst));
}

/// The boundary of a volume mesh before its interior.
namespace winslow::test {
namespace {

std::vector<std::string> all_markers(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
  return names;
}

/// A cube, the nodes inside its sides drawn towards one corner of theirs.
Mesh drawn_cube() {
  MeshData data = cube(6, Volumes::tetrahedra);
  for (Index i = 0; i < data.node_count(); ++i) {
    Vec3 p = data.coordinates.xyz(i);
    int at_ends = 0;
    for (const double c : p) at_ends += c == 0 || c == 1 ? 1 : 0;
    if (at_ends > 1) continue;
    for (double& c : p) c = std::pow(c, 1.4);
    data.coordinates.set_xyz(i, p);
  }
  return make_mesh(data);
}

}  // namespace

TEST_CASE("surface first: the boundary is that of a surface mesh smoothed by itself") {
  const Mesh mesh = drawn_cube();
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  command.smooth.slide.markers = all_markers(mesh);
  command.smooth.slide.surface_first = true;
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK_FALSE(result.smooth.boundary.sliding.empty());
  // A square of the boundary by itself: what smoothing the surface mesh of it leads to.
  const Mesh& after = result.state.mesh;
  const auto faces = boundary_faces(*after.topology);
  MeshData surface;
  surface.coordinates = Coordinates(3, mesh.coordinates.size());
  MeshData smoothed = surface;
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    surface.coordinates.set_xyz(i, mesh.coordinates.xyz(i));
    smoothed.coordinates.set_xyz(i, after.coordinates.xyz(i));
  }
  for (const SurfaceFace& face : faces)
    surface.add_element(ElementType::triangle, std::span(face.nodes.begin(), face.nodes.end()));
  SmoothCommand alone;
  alone.smooth.targets = TargetBlend::regular();
  const CommandResult expected = execute(alone, make_state(make_mesh(surface)));
  REQUIRE(expected.smooth.converged);
  double moved = 0, off = 0;
  for (const SurfaceFace& face : faces)
    for (const Index node : face.nodes) {
      moved = std::max(moved, (after.coordinates.xyz(node) - mesh.coordinates.xyz(node)).norm());
      off = std::max(
          off, (after.coordinates.xyz(node) - expected.state.mesh.coordinates.xyz(node)).norm());
    }
  CHECK(moved > 0.02);
  CHECK(off < 1e-9);
}

TEST_CASE("surface first: what it is not for is refused by name") {
  const MeshState state = make_state(make_mesh(cube(3, Volumes::tetrahedra)));
  SmoothCommand command;
  command.smooth.slide.surface_first = true;
  CHECK_THROWS_WITH_AS(execute(command, state), doctest::Contains("no marker slides"), UsageError);
  const MeshState plane = make_state(make_mesh(square(6, Cells::triangles)));
  command.smooth.slide.markers = {"bottom"};
  CHECK_THROWS_WITH_AS(execute(command, plane), doctest::Contains("volume mesh"), UsageError);
}

}  // namespace winslow::test
