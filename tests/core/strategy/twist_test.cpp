#include "core/strategy/twist.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "support/layered_meshes.h"
#include "support/samples.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The classes of a motion of bodies: all other boundary nodes are fixed.
NodeClasses classes_for(const Mesh& mesh, const Motion& motion) {
  NodeClasses classes(mesh.topology);
  classes.set_prescribed(motion.nodes());
  return classes;
}

/// The mesh after the whole motion, without any smoothing.
Coordinates carried(const Mesh& mesh, const Motion& motion) {
  const NodeClasses classes = classes_for(mesh, motion);
  const auto twist = Twist::find(classes, mesh.coordinates, motion, 1);
  REQUIRE(twist);
  Coordinates x = mesh.coordinates;
  motion.apply(mesh.coordinates, 1, x);
  twist->carry(0, 1, x);
  return x;
}

MovingBody body(const std::string& marker, double rotate, const Vec2& pivot,
                const Vec2& translate = Vec2(0, 0)) {
  MovingBody out{{marker}, {}};
  out.motion.rotate = rotate;
  out.motion.pivot = pivot;
  out.motion.translate = translate;
  return out;
}

RigidMotion space_motion(double rotate, const Vec3& axis, const Vec3& translate) {
  RigidMotion out;
  out.rotate = rotate;
  out.axis = axis;
  out.pivot = Vec3(0.1, -0.2, 0.3);
  out.translate = translate;
  return out;
}

}  // namespace

TEST_CASE("Where nothing is fixed a twist is the rigid motion of the body, whatever its parts") {
  for (const auto& pair :
       {std::pair(Volumes::tetrahedra, space_motion(150, {1, 2, 3}, {0.3, 0.2, -1})),
        std::pair(Volumes::prisms, space_motion(0, {0, 0, 1}, {0.3, 0.2, -1})),
        std::pair(Volumes::hexahedra, space_motion(1e-7, {0, 1, 1}, {0.3, 0.2, -1})),
        std::pair(Volumes::hexahedra, space_motion(-180, {0, 1, 0}, {2, 0.5, 0}))}) {
    const Volumes volumes = pair.first;
    const RigidMotion& motion = pair.second;
    CAPTURE(name_of(volumes));
    CAPTURE(motion.rotate);
    const Mesh mesh = make_mesh(cube(4, volumes));
    std::vector<std::string> all;
    for (const Marker& marker : mesh.topology->markers()) all.push_back(marker.name);
    const auto bodies = make_motion(*mesh.topology, mesh.coordinates, all, motion);
    const Coordinates x = carried(mesh, *bodies);
    for (Index node = 0; node < mesh.coordinates.size(); ++node)
      CHECK((x.xyz(node) - transform(motion, mesh.coordinates.xyz(node))).norm() < 1e-12);
  }
}

TEST_CASE("Bodies that move alike are one body to the nodes between them") {
  const Mesh mesh = make_mesh(square_with_two_holes(10, Cells::triangles));
  std::vector<MovingBody> bodies;
  for (const char* marker : {"hole_a", "hole_b", "outer"})
    bodies.push_back(body(marker, 77, {0.2, 0.1}, {3, 1}));
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, std::span(bodies));
  const Coordinates x = carried(mesh, *motion);
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    const Vec2 rigid = transform(bodies[0].motion, mesh.coordinates.xy(node));
    CHECK((x.xy(node) - rigid).norm() < 1e-12);
  }
}

TEST_CASE("Between a floor that moves and a lid that is fixed the weights follow the height") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    RigidMotion shift;
    shift.axis = Vec3(0, 0, 1);
    shift.translate = Vec3(0.3, -0.2, 0.1);
    const auto motion = make_motion(*mesh.topology, mesh.coordinates, {"floor"}, shift);
    NodeClasses classes(mesh.topology);
    const std::string walls = "walls";
    classes.set_free(mesh.topology->markers().nodes_of(std::span(&walls, 1)));
    const std::string lid = "lid";
    classes.set_fixed(mesh.topology->markers().nodes_of(std::span(&lid, 1)));
    classes.set_prescribed(motion->nodes());
    const auto twist = Twist::find(classes, mesh.coordinates, *motion, 1);
    REQUIRE(twist);
    Coordinates x = mesh.coordinates;
    motion->apply(mesh.coordinates, 1, x);
    twist->carry(0, 1, x);
    for (Index node = 0; node < x.size(); ++node) {
      const Vec3 rest = mesh.coordinates.xyz(node);
      CHECK((x.xyz(node) - rest - (1 - rest.z()) * shift.translate).norm() < 1e-4);
    }
  }
}

TEST_CASE("Nodes turn by their share of the angle, which is that of the logarithm of the radius") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    CAPTURE(name_of(cells));
    const Mesh mesh = make_mesh(annulus(48, 24, 1 + 6.0 / 48, cells));
    const std::vector<MovingBody> bodies{body("inner", 120, {0, 0})};
    const auto motion = make_motion(*mesh.topology, mesh.coordinates, std::span(bodies));
    const Coordinates x = carried(mesh, *motion);
    double largest = 0;
    for (Index node = 0; node < x.size(); ++node)
      largest = std::max(largest, mesh.coordinates.xy(node).norm());
    for (Index node = 0; node < x.size(); ++node) {
      const Vec2 from = mesh.coordinates.xy(node), to = x.xy(node);
      CHECK(to.norm() == doctest::Approx(from.norm()).epsilon(1e-12));
      const double u = std::log(largest / from.norm()) / std::log(largest);
      const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
      CHECK(std::abs(degrees(turn) - 120 * u * u * (3 - 2 * u)) < 0.5);
    }
  }
}

TEST_CASE("A rotation in parts is the rotation at once") {
  const Mesh mesh = make_mesh(square_with_hole(10, Cells::quads));
  const std::vector<MovingBody> bodies{body("hole", 90, {0.4, 0.5})};
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, std::span(bodies));
  const NodeClasses classes = classes_for(mesh, *motion);
  const auto twist = Twist::find(classes, mesh.coordinates, *motion, 1);
  REQUIRE(twist);
  CHECK(twist->largest_turn() == 90);
  Coordinates at_once = mesh.coordinates, in_parts = mesh.coordinates;
  twist->carry(0, 1, at_once);
  for (const auto& [from, to] : {std::pair(0.0, 0.2), {0.2, 0.21}, {0.21, 1.0}})
    twist->carry(from, to, in_parts);
  CHECK(largest_difference(at_once, in_parts) < 1e-13);
  CHECK(largest_difference(at_once, mesh.coordinates) > 0.1);
}

TEST_CASE("Layers of a hundred-thousandth of a body turn with it at once") {
  const Mesh mesh = make_mesh(o_grid(64, distances(50, 1e-5, 1.3, 46), Cut::none, 0.2));
  const std::vector<MovingBody> bodies{body("wall", 170, {0.3, 0})};
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, std::span(bodies));
  const Coordinates x = carried(mesh, *motion);
  CHECK(check_validity(*mesh.topology, x).inverted == 0);
  double worst = 0;
  for (Index i = 0; i < 64; ++i) {
    const auto height = [&](const Coordinates& y) { return (y.xy(i + 64) - y.xy(i)).norm(); };
    worst = std::max(worst, std::abs(height(x) / height(mesh.coordinates) - 1));
  }
  CHECK(worst < 1e-3);
}

TEST_CASE("A motion goes by twists of at most 45 degrees, to the mesh that a longer way reaches") {
  const MeshState state =
      make_state(make_mesh(o_grid(64, distances(50, 1e-5, 1.3, 46), Cut::none, 0.2)));
  const auto turned = [](double degrees) {
    MoveCommand command;
    command.bodies = {body("wall", degrees, {0.3, 0})};
    command.smooth.threads = 1;
    return command;
  };
  const CommandResult moved = execute(turned(80), state);
  REQUIRE(moved.smooth.converged);
  CHECK(moved.smooth.fraction_reached == 1);
  std::vector<double> fractions;
  for (const IterationRecord& record : moved.smooth.history) {
    CHECK(record.inverted == 0);
    if (record.stage == Stage::path) fractions.push_back(record.fraction);
  }
  REQUIRE(fractions.size() == 2);
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(fractions[k] == doctest::Approx(static_cast<double>(k + 1) / 2));
  MeshState stage = state;
  for (const double degrees : {50.0, -20.0, 50.0}) stage = execute(turned(degrees), stage).state;
  CHECK(largest_difference(stage.mesh.coordinates, moved.state.mesh.coordinates) < 1e-8);
}

TEST_CASE("A body in a box of tetrahedra turns by 90 degrees at once") {
  const Mesh mesh = box_with_body(9, Volumes::tetrahedra);
  RigidMotion turn;
  turn.rotate = 90;
  turn.axis = Vec3(1, 0.2, 0.1);
  turn.pivot = Vec3(0.5, 0.5, 0.5);
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, {"body"}, turn);
  CHECK(check_validity(*mesh.topology, carried(mesh, *motion)).inverted == 0);
}

TEST_CASE("A volume goes by twists and first-order steps to the mesh at the end of the path") {
  const MeshState state = make_state(box_with_body(9, Volumes::tetrahedra));
  for (const TargetBlend& targets : {TargetBlend::keeping(), TargetBlend::regular()}) {
    CAPTURE(targets.keep);
    const auto moved = [&](OuterMethod outer, int threads) {
      MoveCommand command;
      MovingBody body{{"body"}, {}};
      body.motion.rotate = 110;
      body.motion.axis = Vec3(0.1, 0.2, 1);
      body.motion.pivot = Vec3(0.5, 0.5, 0.5);
      body.motion.translate = Vec3(0.05, 0, 0.02);
      command.bodies = {body};
      command.smooth.targets = targets;
      command.smooth.outer = outer;
      command.smooth.threads = threads;
      command.smooth.tolerance = 1e-10;
      return execute(command, state);
    };
    const CommandResult by_twists = moved(OuterMethod::descent, 1);
    CHECK(by_twists.smooth.converged);
    CHECK(by_twists.smooth.fraction_reached == 1);
    CHECK(by_twists.smooth.history.back().stage == Stage::descent);
    CHECK(by_twists.smooth.linear_solves == 0);
    std::vector<double> fractions;
    for (const IterationRecord& record : by_twists.smooth.history) {
      CHECK(record.inverted == 0);
      if (fractions.empty() || fractions.back() != record.fraction)
        fractions.push_back(record.fraction);
    }
    CHECK(fractions.size() >= 2);
    CHECK(fractions.front() <= 0.5);  // at most 90 degrees at once
    const CommandResult by_path = moved(OuterMethod::newton, 1);
    CHECK(by_path.smooth.converged);
    CHECK(largest_difference(by_twists.state.mesh.coordinates, by_path.state.mesh.coordinates) <
          1e-7);
    CHECK(moved(OuterMethod::descent, 3).state.mesh.coordinates ==
          by_twists.state.mesh.coordinates);
  }
}

TEST_CASE("Stretched layers of a volume are led along the path") {
  const MeshState state = make_state(layered_cube(Volumes::prisms, 1e-3, 2));
  MoveCommand command;
  MovingBody floor{{"floor"}, {}};
  floor.motion.translate = Vec3(0, 0, 0.1);
  command.bodies = {floor};
  command.smooth.outer = OuterMethod::descent;
  command.smooth.threads = 1;
  const SmoothResult result = execute(command, state).smooth;
  CHECK(result.fraction_reached == 1);
  const auto on_path = std::ranges::count_if(
      result.history, [](const IterationRecord& record) { return record.stage == Stage::path; });
  CHECK(on_path > 0);
}

TEST_CASE("Displacements that are linear on the boundary of a volume are linear inside") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    const auto way = [&](Index node) {
      const Vec3 p = mesh.coordinates.xyz(node);
      return Vec3(0.3 * p.x() - 0.1 * p.z(), 0.2 * p.x() + 0.1, -0.4 * p.y());
    };
    std::vector<Index> nodes;
    std::vector<Vec3> ways;
    for (Index node = 0; node < mesh.coordinates.size(); ++node) {
      if (!mesh.topology->on_boundary(node)) continue;
      nodes.push_back(node);
      ways.push_back(way(node));
    }
    const auto motion = straight_motion<3>(nodes, ways);
    const NodeClasses classes = classes_for(mesh, *motion);
    const auto twist = Twist::find(classes, mesh.coordinates, *motion, 1);
    REQUIRE(twist);
    CHECK(twist->largest_turn() == 0);
    Coordinates half = mesh.coordinates, whole = mesh.coordinates;
    for (const double fraction : {0.5, 1.0}) {
      motion->apply(mesh.coordinates, fraction, whole);
      twist->carry(fraction - 0.5, fraction, whole);
      if (fraction == 0.5) half = whole;
    }
    double worst = 0;
    for (Index node = 0; node < mesh.coordinates.size(); ++node) {
      const Vec3 rest = mesh.coordinates.xyz(node);
      worst = std::max(worst, (half.xyz(node) - rest - 0.5 * way(node)).norm());
      worst = std::max(worst, (whole.xyz(node) - rest - way(node)).norm());
    }
    CHECK(worst < 0.02);  // conductivities of the first iterates are not constant
  }
}

TEST_CASE("A body that a table shifts carries a volume as a rigid body does") {
  const Mesh mesh = box_with_body(9, Volumes::tetrahedra);
  const auto shift = make_motion(*mesh.topology, mesh.coordinates, {"body"},
                                 space_motion(0, {0, 0, 1}, {0.1, 0.05, -0.1}));
  Coordinates end = mesh.coordinates;
  shift->apply(mesh.coordinates, 1, end);
  std::vector<Index> nodes(shift->nodes().begin(), shift->nodes().end());
  std::vector<Vec3> ways;
  for (const Index node : nodes) ways.push_back(end.xyz(node) - mesh.coordinates.xyz(node));
  const Coordinates by_table = carried(mesh, *straight_motion<3>(nodes, ways));
  CHECK(largest_difference(by_table, mesh.coordinates) > 0.1);
  CHECK(largest_difference(by_table, carried(mesh, *shift)) < 1e-4);
}

TEST_CASE("A volume whose body bends goes by displacements to the mesh at the end of the path") {
  const MeshState state = make_state(box_with_body(9, Volumes::tetrahedra));
  const auto moved = [&](OuterMethod outer) {
    DeformCommand command;
    command.markers = {"body"};
    command.shape = SineDeformation{
        .amplitude = 0.06, .waves = 0.25, .direction = Vec3(0, 0, 1), .along = Vec3(1, 0, 0)};
    command.smooth.outer = outer;
    command.smooth.threads = 1;
    command.smooth.tolerance = 1e-10;
    return execute(command, state);
  };
  const CommandResult by_displacements = moved(OuterMethod::descent);
  CHECK(by_displacements.smooth.converged);
  CHECK(by_displacements.smooth.fraction_reached == 1);
  CHECK(by_displacements.smooth.linear_solves == 0);
  for (const IterationRecord& record : by_displacements.smooth.history) {
    CHECK(record.inverted == 0);
    CHECK(record.stage == Stage::descent);
  }
  const CommandResult by_path = moved(OuterMethod::newton);
  CHECK(by_path.smooth.converged);
  CHECK(largest_difference(by_displacements.state.mesh.coordinates,
                           by_path.state.mesh.coordinates) < 1e-7);
}

TEST_CASE("In the plane only rigid bodies carry a mesh along") {
  const Mesh mesh = make_mesh(square_with_hole(10, Cells::triangles));
  const auto turn =
      make_motion(*mesh.topology, mesh.coordinates, {"hole"}, RigidMotion{.rotate = 9});
  CHECK(Twist::find(classes_for(mesh, *turn), mesh.coordinates, *turn, 1));
  const auto sine =
      make_motion(*mesh.topology, mesh.coordinates, {"hole"}, SineDeformation{.amplitude = 0.01});
  CHECK_FALSE(Twist::find(classes_for(mesh, *sine), mesh.coordinates, *sine, 1));
}
