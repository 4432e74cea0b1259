#include "core/drag/drag_predictor.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "core/strategy/workspace.h"

#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// An annulus smoothed, its solver at the solution.
struct Solved {
  explicit Solved(Cells cells) : state(make_state(make_mesh(annulus(32, 10, 1.2, cells)))) {
    SmoothOptions options;
    options.targets = TargetBlend::automatically();
    workspace.prepare(state, std::make_shared<NodeClasses>(state.mesh.topology), options);
    state.mesh.coordinates = solution_after({}, state.mesh.coordinates);
    const Topology& topology = *state.mesh.topology;
    const auto span = topology.markers().nodes(*topology.markers().find("inner"));
    nodes.assign(span.begin(), span.end());
  }
  /// The solution with the inner circle moved, from a mesh near it.
  Coordinates solution_after(const RigidMotion& motion, Coordinates near) {
    make_motion(*state.mesh.topology, state.mesh.coordinates, {"inner"}, motion)
        ->apply(state.mesh.coordinates, 1, near);
    EnergyNewton& newton = workspace.newton();
    newton.start(near);
    for (int i = 0; i < 50 && !newton.converged(); ++i) newton.step(near);
    REQUIRE(newton.converged());
    return near;
  }

  MeshState state;
  SmoothingWorkspace workspace;
  std::vector<Index> nodes;
};

}  // namespace

TEST_CASE("the prediction errs by the square of the motion, and not at all on the boundary") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Solved solved(cells);
    const Mesh& mesh = solved.state.mesh;
    solved.workspace.newton().reject();
    const DragPredictor predictor(solved.workspace.newton(), mesh.coordinates, solved.nodes);
    const auto error = [&](double size) {
      const RigidMotion motion{20 * size, Vec2(0.3, -0.2), Vec2(0.2 * size, 0.1 * size)};
      Coordinates predicted;
      predictor.evaluate(motion, predicted);
      for (const Index node : solved.nodes) {
        const Vec2 expected = transform(motion, mesh.coordinates.xy(node));
        CHECK((predicted.xy(node) - expected).norm() == 0);
      }
      for (const Index node :
           mesh.topology->markers().nodes(*mesh.topology->markers().find("outer"))) {
        CHECK((predicted.xy(node) - mesh.coordinates.xy(node)).norm() == 0);
      }
      return largest_difference(predicted, solved.solution_after(motion, predicted));
    };
    const double whole = error(1), half = error(0.5), quarter = error(0.25);
    CHECK(half < 0.35 * whole);
    CHECK(quarter < 0.35 * half);
    CHECK(whole < 0.1);
  }
}

TEST_CASE("no motion predicts the mesh itself, and threads change no bit") {
  Solved solved(Cells::mixed);
  const Mesh& mesh = solved.state.mesh;
  const DragPredictor one(solved.workspace.newton(), mesh.coordinates, solved.nodes, {}, 1);
  const DragPredictor four(solved.workspace.newton(), mesh.coordinates, solved.nodes, {}, 4);
  Coordinates a, b;
  one.evaluate({}, a);
  CHECK(a == mesh.coordinates);
  const RigidMotion motion{35, Vec2(0, 0), Vec2(0.1, 0)};
  one.evaluate(motion, a);
  four.evaluate(motion, b);
  CHECK(a == b);
}
