#include "core/drag/drag_session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"
#include "support/wait.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState annulus_state(Cells cells = Cells::triangles, Index rings = 12) {
  return make_state(make_mesh(annulus(32, rings, 1.2, cells)));
}

Index inverted(const MeshState& state, const Coordinates& x) {
  return check_validity(*state.mesh.topology, x, 1).inverted;
}

}  // namespace

TEST_CASE("a drag ends at the mesh that the command gives") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const MeshState state = annulus_state(cells);
    DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {});
    MoveCommand command;
    command.bodies[0].markers = {"inner"};
    for (int k = 1; k <= 20; ++k) {
      command.bodies[0].motion = {4.0 * k, Vec2(0.1, 0), Vec2(0.02 * k, 0.01 * k)};
      const DragFrame& frame = drag.to(command.bodies[0].motion);
      CHECK(inverted(state, frame.coordinates) == 0);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(wait_until([&] {
      drag.to(command.bodies[0].motion);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(command.bodies[0].motion);
    CHECK_FALSE(frame.held);
    CHECK(same_motion(frame.motion, command.bodies[0].motion));
    CHECK(largest_difference(frame.coordinates, execute(command, state).state.mesh.coordinates) <
          1e-8);
    CHECK(drag.corrections() >= 2);
    CHECK(drag.error().empty());
  }
}

TEST_CASE(
    "a drag far from the origin shows the mesh where it is, and ends where the command does") {
  const Vec2 away(1e7, -3e7);
  MeshData data = annulus(32, 8, 1.2, Cells::triangles);
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + away);
  const MeshState state = make_state(make_mesh(data));
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion = {30, away + Vec2(0.1, 0), Vec2(0.1, 0.05)};
  const RigidMotion wanted = command.bodies[0].motion;
  const Coordinates there = execute(command, state).state.mesh.coordinates;
  constexpr double ulp = 0x1p-28;  // of coordinates around 3e7
  {
    DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {});
    REQUIRE(wait_until([&] {
      drag.to(wanted);
      return drag.settled();
    }));
    const DragFrame& frame = drag.to(wanted);
    CHECK_FALSE(frame.held);
    CHECK(same_motion(frame.motion, wanted));
    CHECK(largest_difference(frame.coordinates, there) < 2 * ulp);
    for (Index i = 0; i < there.size(); ++i) {
      const auto inner = state.mesh.topology->markers().nodes_of(command.bodies[0].markers);
      const bool moved = std::ranges::binary_search(inner, i);
      if (state.mesh.topology->on_boundary(i) && !moved)
        CHECK(frame.coordinates.xy(i) == state.mesh.coordinates.xy(i));
    }
  }
  // One that goes on from a mesh on the way says it in the same coordinates.
  DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {}, DragSession::Start{there, wanted});
  CHECK(largest_difference(drag.to(wanted).coordinates, there) < 2 * ulp);
  CHECK(same_motion(drag.to(wanted).motion, wanted));
}

TEST_CASE("by the paper's operator a drag ends at that operator's mesh") {
  const MeshState state = annulus_state();
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion = {30, Vec2(0, 0), Vec2(0.2, 0)};
  command.smooth.formulation = Formulation::pointwise;
  DragSession drag(state, DragGrip{{"inner"}, {}, {}}, command.smooth);
  REQUIRE(wait_until([&] {
    const DragFrame& frame = drag.to(command.bodies[0].motion);
    CHECK(inverted(state, frame.coordinates) == 0);
    return drag.settled() && !frame.held;
  }));
  const Coordinates there = drag.to(command.bodies[0].motion).coordinates;
  CHECK(largest_difference(there, execute(command, state).state.mesh.coordinates) < 1e-7);
  // To first order the frames go on from there as the operator's own solution does.
  const double step = 1e-3;
  command.bodies[0].motion.translate.x() += step;
  const Coordinates next = drag.to(command.bodies[0].motion).coordinates;
  CHECK(largest_difference(next, execute(command, state).state.mesh.coordinates) < 0.02 * step);
}

TEST_CASE("a frame that would invert an element is held at the last valid position") {
  const MeshState state = annulus_state();
  DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {});
  REQUIRE(wait_until([&] { return drag.ready(); }));
  const RigidMotion easy{0, Vec2(0, 0), Vec2(0.3, 0)};
  CHECK_FALSE(drag.to(easy).held);
  const Coordinates last = drag.to(easy).coordinates;
  // Beyond the outer circle: no mesh is valid there.
  const RigidMotion outside{0, Vec2(0, 0), Vec2(50, 0)};
  CHECK(drag.to(outside).held);
  CHECK(inverted(state, drag.to(outside).coordinates) == 0);
  CHECK(same_motion(drag.to(outside).motion, easy));
  CHECK(drag.to(outside).coordinates == last);
  // Only the answer to this very position makes it the limit.
  REQUIRE(wait_until([&] { return drag.to(outside).limit; }));
  CHECK(drag.settled());
  CHECK(drag.to(outside).held);
  // It comes back from there.
  REQUIRE(wait_until([&] { return !drag.to(easy).held && drag.settled(); }));
  CHECK_FALSE(drag.to(easy).limit);
  CHECK(drag.error().empty());
}

TEST_CASE("turning on and on winds the mesh up, and back") {
  const MeshState state = annulus_state(Cells::triangles, 24);
  DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {});
  const auto turn_to = [&](double degrees) {
    const RigidMotion motion{degrees, Vec2(0, 0), Vec2(0, 0)};
    return wait_until([&] {
      const DragFrame& frame = drag.to(motion);
      CHECK(inverted(state, frame.coordinates) == 0);
      return drag.settled() && !frame.held;
    });
  };
  REQUIRE(turn_to(0));
  const Coordinates flat = drag.to({}).coordinates;
  REQUIRE(turn_to(200));  // at once, and still not the shorter way round
  const Coordinates wound = drag.to(RigidMotion{200, Vec2(0, 0), Vec2(0, 0)}).coordinates;
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion.rotate = 200;
  CHECK(largest_difference(wound, execute(command, state).state.mesh.coordinates) < 1e-7);
  REQUIRE(turn_to(0));
  CHECK(largest_difference(drag.to({}).coordinates, flat) < 1e-7);
}

TEST_CASE("a drag that cannot begin says why; one that is under way can be dropped at any time") {
  MeshState state = annulus_state();
  CHECK_THROWS_AS(DragSession(state, DragGrip{{"wing"}, {}, {}}, {}), UsageError);
  SmoothOptions bad;
  bad.damping = 7;
  CHECK_THROWS_AS(DragSession(state, DragGrip{{"inner"}, {}, {}}, bad), UsageError);
  for (int k = 0; k < 6; ++k) {
    DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {});
    drag.to(RigidMotion{30.0 * k, Vec2(0, 0), Vec2(0, 0)});
    std::this_thread::sleep_for(std::chrono::milliseconds(k));
  }
  Random random(1);
  tangle(state.mesh, random);
  CHECK_THROWS_AS(DragSession(state, DragGrip{{"inner"}, {}, {}}, {}), UsageError);
}

TEST_CASE("a part of a boundary is dragged by its shares and ends at the command's mesh") {
  const MeshState state = annulus_state();
  const Mesh& mesh = state.mesh;
  const auto span = mesh.topology->markers().nodes(*mesh.topology->markers().find("inner"));
  std::vector<Index> loop;
  for (const auto& candidate : mesh.topology->boundary_loops())
    if (std::find(candidate.begin(), candidate.end(), span[0]) != candidate.end()) loop = candidate;
  const FadedArc arc = faded_arc(loop, mesh.coordinates, 3, 5, 0.6);
  REQUIRE(arc.nodes.size() > 5);
  const DragGrip grip{{"inner"}, arc.nodes, arc.shares};
  DragSession drag(state, grip, {});
  const RigidMotion motion{0, Vec2(0, 0), Vec2(0.15, 0.1)};
  REQUIRE(wait_until([&] {
    const DragFrame& frame = drag.to(motion);
    CHECK(inverted(state, frame.coordinates) == 0);
    return drag.settled() && !frame.held;
  }));
  const Coordinates there = drag.to(motion).coordinates;
  const Command command = drag_command(grip, motion, {}, {});
  CHECK(std::holds_alternative<DeformCommand>(command));
  CHECK(largest_difference(there, execute(command, state).state.mesh.coordinates) < 1e-8);
  for (std::size_t i = 0; i < arc.nodes.size(); ++i) {
    const Vec2 wanted =
        mesh.coordinates.xy(arc.nodes[i]) + arc.shares[i] * motion.translate.head<2>();
    CHECK((there.xy(arc.nodes[i]) - wanted).norm() < 1e-14);
  }
  // From there the frames are exact to first order, whatever the shares.
  RigidMotion further = motion;
  further.translate.x() += 1e-3;
  const Coordinates next = drag.to(further).coordinates;
  const Coordinates exact =
      execute(drag_command(grip, further, {}, {}), state).state.mesh.coordinates;
  CHECK(largest_difference(next, exact) < 2e-5);
  CHECK_THROWS_AS(drag_command({{"inner"}, arc.nodes, {}}, motion, {}, {}), UsageError);
  CHECK_THROWS_AS(drag_command(grip, RigidMotion{5, Vec2(0, 0), Vec2(0, 0)}, {}, {}), UsageError);
}

TEST_CASE("a drag goes on from a mesh on the way, not from the state") {
  const MeshState state = annulus_state();
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion = {25, Vec2(0, 0), Vec2(0.2, 0)};
  const Coordinates there = execute(command, state).state.mesh.coordinates;
  DragSession drag(state, DragGrip{{"inner"}, {}, {}}, {},
                   DragSession::Start{there, command.bodies[0].motion});
  const Coordinates first = drag.to(command.bodies[0].motion).coordinates;
  // To the bit, unless the thread has solved there before the first question.
  if (!drag.ready()) CHECK(first == there);
  CHECK(largest_difference(first, there) < 1e-8);
  CHECK(same_motion(drag.to(command.bodies[0].motion).motion, command.bodies[0].motion));
  REQUIRE(wait_until([&] { return drag.ready(); }));
  RigidMotion next = command.bodies[0].motion;
  next.translate.y() += 0.01;
  const DragFrame& frame = drag.to(next);
  CHECK_FALSE(frame.held);
  CHECK(largest_difference(frame.coordinates, there) < 0.02);
}

TEST_CASE("shares fade along the loop, not through the body") {
  // A square of side 1 with nodes every 0.25, counter-clockwise from (0, 0).
  Coordinates x(2, 16);
  std::vector<Index> loop(16);
  for (Index i = 0; i < 16; ++i) {
    const double s = 0.25 * static_cast<double>(i % 4);
    const Vec2 corner[4] = {{s, 0}, {1, s}, {1 - s, 1}, {0, 1 - s}};
    x.set_xy(i, corner[i / 4]);
    loop[static_cast<std::size_t>(i)] = i;
  }
  const auto share_of = [](const FadedArc& arc, Index node) {
    for (std::size_t i = 0; i < arc.nodes.size(); ++i)
      if (arc.nodes[i] == node) return arc.shares[i];
    return 0.0;
  };
  const FadedArc one = faded_arc(loop, x, 0, 0, 0);
  CHECK(one.nodes == std::vector<Index>{0});
  CHECK(one.shares == std::vector<double>{1});
  // Over the corner and over the end of the list.
  const FadedArc arc = faded_arc(loop, x, 15, 1, 0.5);
  for (const Index node : {15, 0, 1}) CHECK(share_of(arc, node) == 1);
  CHECK(share_of(arc, 2) == doctest::Approx(0.5));
  CHECK(share_of(arc, 14) == doctest::Approx(0.5));
  CHECK(arc.nodes.size() == 5);
  // A radius longer than the loop reaches every node once, from its nearer end.
  const FadedArc all = faded_arc(loop, x, 0, 0, 4);
  CHECK(all.nodes.size() == 16);
  CHECK(share_of(all, 4) == doctest::Approx(share_of(all, 12)));
  CHECK(share_of(all, 8) == doctest::Approx(0.5));
}

TEST_CASE("a drag into another body shows how far it came and what is in the way") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
  DragSession drag(state, DragGrip{{"hole_a"}, {}, {}}, {});
  const RigidMotion beyond{0, Vec2(0, 0), Vec2(0.3, 0.02)};
  double last = 0;
  REQUIRE(wait_until([&] {
    const DragFrame& frame = drag.to(beyond);
    CHECK(inverted(state, frame.coordinates) == 0);
    CHECK(frame.held);
    CHECK(frame.motion.translate.x() >= last);
    last = frame.motion.translate.x();
    return frame.limit;
  }));
  const DragFrame& frame = drag.to(beyond);
  CHECK(frame.motion.translate.x() > 0.1);
  CHECK(frame.motion.translate.x() < 0.2);
  CHECK(drag.revision() > drag.corrections());
  CHECK(frame.motion.rotate == 0);
  CHECK(frame.share == doctest::Approx(frame.motion.translate.x() / 0.3).epsilon(1e-6));
  REQUIRE(frame.contact);
  CHECK(describe_touch(*frame.contact) == "hole_a would touch hole_b");
  // Away from there nothing is in the way.
  REQUIRE(wait_until([&] { return !drag.to({0, Vec2(0, 0), Vec2(-0.05, 0)}).held; }));
  CHECK_FALSE(drag.to({0, Vec2(0, 0), Vec2(-0.05, 0)}).contact);
}

namespace {

/// The surface of a cube around (0.5, 0.5, 0.5), in a file by name.
ReferenceSurface box_surface(double size, const Vec3& away = Vec3(0, 0, 0)) {
  const MeshData data = skin(cube(4, Volumes::hexahedra));
  ReferenceSurface out;
  out.source = "box.obj";
  for (Index i = 0; i < data.node_count(); ++i)
    out.points.push_back(Vec3::Constant(0.5) +
                         size * (data.coordinates.xyz(i) - Vec3::Constant(0.5)) + away);
  for (Index e = 0; e < data.element_count(); ++e) out.faces.emplace_back(data.element(e));
  return out;
}

/// A cavity in a cube, whose outside slides on a surface.
struct Cavity {
  explicit Cavity(const Vec3& away = Vec3(0, 0, 0), Index n = 6)
      : state(make_state(mesh(away, n))) {
    options.slide.markers = {"outer"};
    options.slide.reference = "box.obj";
    wanted.translate = Vec3(0.05, 0.02, 0);
    wanted.pivot = Vec3::Constant(0.5) + away;
  }
  static Mesh mesh(const Vec3& away, Index n) {
    Mesh mesh = make_mesh(cube_with_cavity(n, Volumes::tetrahedra));
    for (Index i = 0; i < mesh.coordinates.size(); ++i)
      mesh.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + away);
    return mesh;
  }
  static SlideFiles on(const ReferenceSurface& surface) {
    return {.reference = std::make_shared<ReferenceSurface>(surface)};
  }
  /// What the command makes of it that ends the drag.
  Coordinates moved(const ReferenceSurface& surface) const {
    MoveCommand command{{{{"cavity"}, wanted}}, {}, options};
    command.smooth.tolerance = 1e-10;
    return execute(ResolvedCommand(command, on(surface)), state).state.mesh.coordinates;
  }

  MeshState state;
  SmoothOptions options;
  RigidMotion wanted;
};

/// Largest distance of the outer nodes from the box of that size.
double off_box(const Mesh& mesh, const Coordinates& x, double size, const Vec3& away) {
  double largest = 0;
  const std::vector<std::string> outer{"outer"};
  for (const Index node : mesh.topology->markers().nodes_of(outer)) {
    const Vec3 p = x.xyz(node) - away - Vec3::Constant(0.5);
    largest = std::max(largest, std::abs(p.cwiseAbs().maxCoeff() - size / 2));
  }
  return largest;
}

}  // namespace

TEST_CASE("a drag slides on its reference surface, as the command that ends it does") {
  for (const Vec3& away : {Vec3(0, 0, 0), Vec3(4.5e5, 5.1e6, 300)}) {
    CAPTURE(away.transpose());
    const Cavity cavity(away);
    const ReferenceSurface surface = box_surface(1.02, away);
    DragSession drag(cavity.state, DragGrip{{"cavity"}, {}, {}}, cavity.options, {},
                     Cavity::on(surface));
    REQUIRE(wait_until([&] {
      drag.to(cavity.wanted);
      return drag.settled() || !drag.error().empty();
    }));
    REQUIRE(drag.error() == "");
    const DragFrame& frame = drag.to(cavity.wanted);
    CHECK_FALSE(frame.held);
    CHECK(check_validity(*cavity.state.mesh.topology, frame.coordinates, 1).inverted == 0);
    // Nodes on edges, which do not slide, stay where they were.
    CHECK(off_box(cavity.state.mesh, frame.coordinates, 1, away) ==
          doctest::Approx(0.01).epsilon(1e-6));
    CHECK(largest_difference(frame.coordinates, cavity.moved(surface)) < 1e-7);
  }
}

TEST_CASE("a drag that goes on from a mesh beside the reference surface comes to the same mesh") {
  const Cavity cavity;
  const ReferenceSurface surface = box_surface(1.02);
  DragSession drag(cavity.state, DragGrip{{"cavity"}, {}, {}}, cavity.options,
                   DragSession::Start{cavity.state.mesh.coordinates, {}}, Cavity::on(surface));
  REQUIRE(wait_until([&] {
    drag.to(cavity.wanted);
    return drag.settled() || !drag.error().empty();
  }));
  REQUIRE(drag.error() == "");
  CHECK(largest_difference(drag.to(cavity.wanted).coordinates, cavity.moved(surface)) < 1e-7);
}

TEST_CASE(
    "a drag whose reference surface does not fit says why and stays; without it none begins") {
  const Cavity cavity(Vec3(0, 0, 0), 12);
  const DragGrip grip{{"cavity"}, {}, {}};
  DragSession drag(cavity.state, grip, cavity.options, {}, Cavity::on(box_surface(0.8)));
  REQUIRE(wait_until([&] {
    drag.to(cavity.wanted);
    return !drag.error().empty();
  }));
  const DragFrame& frame = drag.to(cavity.wanted);
  CHECK(frame.held);
  CHECK(frame.coordinates == cavity.state.mesh.coordinates);
  const std::string fault = drag.error();
  CAPTURE(fault);
  CHECK(fault.find("smooth the mesh on it first") != std::string::npos);
  CHECK_THROWS_WITH_AS(DragSession(cavity.state, grip, cavity.options),
                       "box.obj: this reference surface was not read", UsageError);
  // What is shown while the surface is being read.
  const DragFrame first = DragSession::first_frame(cavity.state, grip, cavity.options, nullptr);
  CHECK(first.coordinates == cavity.state.mesh.coordinates);
  CHECK_FALSE(first.held);
  CHECK_THROWS_AS(
      DragSession::first_frame(cavity.state, DragGrip{{"none"}, {}, {}}, cavity.options, nullptr),
      UsageError);
}
