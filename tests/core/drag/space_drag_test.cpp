#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/drag/drag_predictor.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "support/polygon_meshes.h"
#include "support/space_meshes.h"
#include "support/wait.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A box around a body, smoothed, its solver at the solution.
struct SolvedBox {
  explicit SolvedBox(Volumes volumes) : state(make_state(box_with_body(5, volumes))) {
    SmoothOptions options;
    options.targets = TargetBlend::regular();
    workspace.prepare(state, std::make_shared<NodeClasses>(state.mesh.topology), options);
    state.mesh.coordinates = solution_after({}, state.mesh.coordinates);
    nodes = state.mesh.topology->markers().nodes_of(std::vector<std::string>{"body"});
  }
  /// The solution with the body moved, from a mesh near it.
  Coordinates solution_after(const RigidMotion& motion, Coordinates near) {
    make_motion(*state.mesh.topology, state.mesh.coordinates, {"body"}, motion)
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

TEST_CASE("in space the prediction errs by the square of the motion, too") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::mixed}) {
    CAPTURE(name_of(volumes));
    SolvedBox solved(volumes);
    const Mesh& mesh = solved.state.mesh;
    solved.workspace.newton().reject();
    const DragPredictor predictor(solved.workspace.newton(), mesh.coordinates, solved.nodes);
    Coordinates still;
    predictor.evaluate({}, still);
    CHECK(still == mesh.coordinates);
    const auto error = [&](double size) {
      const RigidMotion motion{15 * size, Vec3(0.5, 0.4, 0.6), size * Vec3(0.02, 0.01, -0.03),
                               Vec3(1, -2, 0.5)};
      Coordinates predicted;
      predictor.evaluate(motion, predicted);
      for (Index node = 0; node < mesh.topology->node_count(); ++node) {
        if (!mesh.topology->on_boundary(node)) continue;
        const bool moves = std::ranges::binary_search(solved.nodes, node);
        const Vec3 rest = mesh.coordinates.xyz(node);
        CHECK(predicted.xyz(node) == (moves ? transform(motion, rest) : rest));
      }
      return largest_difference(predicted, solved.solution_after(motion, predicted));
    };
    const double whole = error(1), half = error(0.5), quarter = error(0.25);
    CHECK(half < 0.35 * whole);
    CHECK(quarter < 0.35 * half);
    CHECK(whole < 0.02);
  }
}

TEST_CASE("a drag in space shows valid meshes only, and ends at the mesh that the command gives") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::mixed}) {
    CAPTURE(name_of(volumes));
    const MeshState state = make_state(box_with_body(5, volumes));
    DragSession drag(state, DragGrip{{"body"}, {}, {}}, {});
    MoveCommand command;
    command.bodies[0].markers = {"body"};
    command.smooth.tolerance = 1e-10;  // as in a drag
    RigidMotion wanted;
    for (int k = 1; k <= 15; ++k) {
      wanted = {2.0 * k, Vec3(0.5, 0.5, 0.4), 0.004 * k * Vec3(1, -1, 0.5), Vec3(1, 1, 2)};
      const DragFrame& frame = drag.to(wanted);
      CHECK(check_validity(*state.mesh.topology, frame.coordinates, 1).inverted == 0);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(wait_until([&] {
      drag.to(wanted);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(wanted);
    CHECK_FALSE(frame.held);
    CHECK(same_motion(frame.motion, wanted));
    command.bodies[0].motion = wanted;
    CHECK(largest_difference(frame.coordinates, execute(command, state).state.mesh.coordinates) <
          1e-7);
    CHECK(drag.error().empty());
  }
}

TEST_CASE("a drag in space far from the origin shows the mesh where it is") {
  const Vec3 away(4.5e5, 5.1e6, 300);
  constexpr double ulp = 0x1p-30;  // of coordinates around 5e6
  Mesh mesh = box_with_body(5, Volumes::tetrahedra);
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    mesh.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + away);
  const MeshState state = make_state(mesh);
  MoveCommand command;
  command.bodies[0].markers = {"body"};
  const RigidMotion wanted{20, away + Vec3(0.5, 0.5, 0.4), Vec3(0.05, -0.04, 0.02), Vec3(1, 1, 2)};
  command.bodies[0].motion = wanted;
  command.smooth.tolerance = 1e-10;
  const Coordinates there = execute(command, state).state.mesh.coordinates;
  const auto body = mesh.topology->markers().nodes_of(command.bodies[0].markers);
  {
    DragSession drag(state, DragGrip{{"body"}, {}, {}}, {});
    REQUIRE(wait_until([&] {
      drag.to(wanted);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(wanted);
    CHECK_FALSE(frame.held);
    CHECK(same_motion(frame.motion, wanted));
    CHECK(largest_difference(frame.coordinates, there) < 1e-7);
    for (Index i = 0; i < there.size(); ++i) {
      if (mesh.topology->on_boundary(i) && !std::ranges::binary_search(body, i))
        CHECK(frame.coordinates.same_place(i, mesh.coordinates));
    }
  }
  // One that goes on from a mesh on the way says it in the same coordinates.
  DragSession drag(state, DragGrip{{"body"}, {}, {}}, {}, DragSession::Start{there, wanted});
  CHECK(largest_difference(drag.to(wanted).coordinates, there) < 2 * ulp);
  CHECK(same_motion(drag.to(wanted).motion, wanted));
}

TEST_CASE("a drag in space goes on beyond a full turn") {
  const MeshState state = make_state(box_with_body(5, Volumes::tetrahedra));
  DragSession drag(state, DragGrip{{"body"}, {}, {}}, {});
  const Vec3 centre(0.5, 0.5, 0.5);
  RigidMotion wanted;
  for (const double angle : {60.0, 120.0, 180.0}) {
    wanted = {angle, centre, Vec3(0, 0, 0), Vec3(0, 0, 1)};
    REQUIRE(wait_until([&] {
      drag.to(wanted);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(wanted);
    CHECK(check_validity(*state.mesh.topology, frame.coordinates, 1).inverted == 0);
    if (!frame.held) continue;
    // Where so coarse a mesh cannot be wound up further, it says how far it came.
    CHECK(frame.motion.rotate > 60);
    CHECK(frame.motion.rotate < angle);
    CHECK(frame.share < 1);
  }
}

TEST_CASE("a part of a body is dragged in space, each node by its share") {
  const MeshState state = make_state(box_with_body(5, Volumes::tetrahedra));
  DragGrip grip{{"body"}, {}, {}};
  grip.nodes = state.mesh.topology->markers().nodes_of(std::vector<std::string>{"body"});
  for (std::size_t i = 0; i < grip.nodes.size(); ++i)
    grip.shares.push_back(static_cast<double>(i % 3) / 2);
  RigidMotion wanted;
  wanted.translate = Vec3(0.02, -0.01, 0.03);
  DragSession drag(state, grip, {});
  REQUIRE(wait_until([&] {
    drag.to(wanted);
    return drag.settled();
  }));
  const DragFrame& frame = drag.to(wanted);
  CHECK_FALSE(frame.held);
  CHECK(check_validity(*state.mesh.topology, frame.coordinates, 1).inverted == 0);
  for (std::size_t i = 0; i < grip.nodes.size(); ++i) {
    const Vec3 there =
        state.mesh.coordinates.xyz(grip.nodes[i]) + grip.shares[i] * wanted.translate;
    CHECK((frame.coordinates.xyz(grip.nodes[i]) - there).norm() < 1e-15);
  }
  SmoothOptions smooth;
  smooth.tolerance = 1e-10;
  const CommandResult same = execute(drag_command(grip, frame.motion, {}, smooth), state);
  CHECK(largest_difference(frame.coordinates, same.state.mesh.coordinates) < 1e-7);
  wanted.rotate = 5;
  CHECK_THROWS_AS(drag_command(grip, wanted, {}, {}), UsageError);
}

TEST_CASE("a drag of a node takes it there and back in meshes of polyhedra and of polygons") {
  struct Case {
    const char* marker;
    MeshData data;
    Vec3 way;
  };
  for (const Case& sample :
       {Case{"body", split_box_with_body(6), Vec3(0.03, -0.02, 0.04)},
        Case{"hole", dual_of(make_mesh(square_with_hole(10, Cells::triangles))),
             Vec3(0.02, 0.01, 0)},
        Case{"hole", quadtree_with_hole(10), Vec3(0.01, -0.015, 0)}}) {
    const MeshState state = make_state(make_mesh(sample.data));
    const Topology& topology = *state.mesh.topology;
    const std::vector<std::string> names{sample.marker};
    const DragGrip grip{names, {topology.markers().nodes_of(names)[3]}, {1.0}};
    const auto drag_to = [&](DragSession& drag, const RigidMotion& wanted) {
      REQUIRE(wait_until([&] {
        const DragFrame& frame = drag.to(wanted);
        CHECK(check_validity(topology, frame.coordinates, 1).inverted == 0);
        return drag.settled() && !frame.held;
      }));
      CHECK(drag.error().empty());
      return drag.to(wanted).coordinates;
    };
    DragSession drag(state, grip, {});
    const auto by = [&](double share) {
      RigidMotion motion;
      if (topology.kind() == MeshKind::volume)
        motion.translate = share * sample.way;
      else
        motion.translate = Vec2(share * sample.way.head<2>());
      return motion;
    };
    const RigidMotion wanted = by(1);
    const Coordinates there = drag_to(drag, wanted);
    const auto place = [](const Coordinates& x, Index node) {
      return x.dimension() == 3 ? x.xyz(node) : Vec3(x.xy(node).x(), x.xy(node).y(), 0);
    };
    for (const Index node : topology.markers().nodes_of(names)) {
      const Vec3 way = place(there, node) - place(state.mesh.coordinates, node);
      CHECK((way - (node == grip.nodes[0] ? sample.way : Vec3(0, 0, 0))).norm() < 1e-14);
    }
    SmoothOptions smooth;
    smooth.tolerance = 1e-10;
    const CommandResult same =
        execute(drag_command(grip, drag.to(wanted).motion, {}, smooth), state);
    CHECK(largest_difference(there, same.state.mesh.coordinates) < 1e-7);
    CHECK(largest_difference(there, state.mesh.coordinates) > 0.9 * sample.way.norm());
    CHECK(largest_difference(drag_to(drag, by(0)), state.mesh.coordinates) < 1e-7);
  }
}

TEST_CASE("a drag wants a motion that its mesh has") {
  const DragGrip grip{{"body"}, {}, {}};
  const MeshState space = make_state(box_with_body(3, Volumes::hexahedra));
  const MeshState plane = make_state(make_mesh(annulus(16, 4, 1.2, Cells::triangles)));
  RigidMotion turned{.rotate = 10};
  CHECK_THROWS_WITH_AS(DragSession(space, grip, {}).to(turned), "a rotation in space needs an axis",
                       UsageError);
  turned.axis = Vec3(0, 0, 1);
  CHECK_THROWS_WITH_AS(
      DragSession(plane, DragGrip{{"inner"}, {}, {}}, {}).to(turned),
      "an axis or a third component: only for a volume mesh, and this is a plane mesh", UsageError);
  CHECK_THROWS_AS(DragSession(space, DragGrip{{"nobody"}, {}, {}}, {}), UsageError);
}

TEST_CASE("a drag keeps a body on the planes on which it stands, which give way") {
  const MeshState state =
      make_state(make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra)));
  DragSession drag(state, DragGrip{{"body"}, {}, {}}, {});
  // Off both planes, and turned about an axis that leaves one of them.
  const RigidMotion wanted{0, Vec3(0.5, 0, 0), Vec3(0.15, -0.05, 0.1), Vec3(0, 0, 1)};
  const RigidMotion along = drag.along(wanted);
  CHECK((Vec3(along.translate) - Vec3(0.15, 0, 0)).norm() < 1e-14);
  RigidMotion turned = wanted;
  turned.rotate = 10;
  CHECK(drag.along(turned).rotate == 0);
  REQUIRE(wait_until([&] {
    drag.to(wanted);
    return drag.settled();
  }));
  const DragFrame& frame = drag.to(wanted);
  CHECK(drag.error().empty());
  CHECK_FALSE(frame.held);
  CHECK(same_motion(frame.motion, along));
  MoveCommand command;
  command.bodies[0].markers = {"body"};
  command.bodies[0].motion = along;
  command.smooth.tolerance = 1e-10;
  CHECK(largest_difference(frame.coordinates, execute(command, state).state.mesh.coordinates) <
        1e-7);
}
