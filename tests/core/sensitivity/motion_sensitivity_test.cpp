#include "core/error.h"
#include "core/motion/node_table.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/sensitivities.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

using Commands = std::function<Command(double parameter)>;

Mesh moved_by(const Commands& commands, double parameter, const MeshState& state) {
  const CommandResult result = execute(commands(parameter), state);
  REQUIRE(result.smooth.converged);
  REQUIRE(result.smooth.fraction_reached == 1);
  return result.state.mesh;
}

/// Compares forward products with differences of runs, of which they know the boundary() alone.
MeshSensitivity check(const Commands& commands, const MeshState& state, double step) {
  const Mesh mesh = moved_by(commands, 0, state);
  MeshSensitivity sensitivity(state, commands(0), mesh.coordinates);
  const Coordinates expected = difference_of(
      [&](double parameter) { return moved_by(commands, parameter, state).coordinates; }, step);
  CHECK(largest_inside(*mesh.topology, expected) > 0.1);
  Coordinates boundary(mesh.coordinates.dimension(), mesh.coordinates.size());
  for (const Index node : sensitivity.boundary()) boundary.copy_node(node, expected);
  CHECK(error_of(sensitivity.forward(boundary), expected) < 1e-6);
  check_transpose(sensitivity);
  return sensitivity;
}

/// Half an annulus above a floor, which is the x axis, or a circle of this radius below it; markers
/// body, floor, far.
MeshState half_ring(Index sectors, Index rings, double floor_radius = 0) {
  MeshData data;
  double radius = 1;
  for (Index i = 0; i <= rings; ++i, radius *= 1.2)
    for (Index j = 0; j <= sectors; ++j) {
      const double phi = pi * (1 - static_cast<double>(j) / sectors);
      data.coordinates.push_xy(radius * Vec2(std::cos(phi), std::sin(phi)));
    }
  const auto id = [&](Index i, Index j) { return i * (sectors + 1) + j; };
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sectors; ++j)
      add_quad(data, id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j));
  mark_boundary(data, [](const Vec2& p) {
    if (std::abs(p.y()) < 1e-9) return "floor";
    return p.norm() < 1 + 1e-9 ? "body" : "far";
  });
  for (Index node = 0; floor_radius > 0 && node < data.node_count(); ++node) {
    const Vec2 p = data.coordinates.xy(node);
    const double r = floor_radius + p.y(), phi = p.x() / floor_radius;
    data.coordinates.set_xy(node, Vec2(r * std::sin(phi), r * std::cos(phi) - floor_radius));
  }
  return make_state(make_mesh(data));
}

/// A square with periodic sides that a body crosses: markers left, right, body_left, body_right,
/// walls.
MeshState body_across_sides() {
  const auto inside = [](Index i, Index j) { return (i < 2 || i > 7) && j > 2 && j < 7; };
  MeshData data = grid_with_holes(10, Cells::triangles, inside);
  mark_boundary(data, [](const Vec2& p) {
    if (p.x() < 1e-9) return "left";
    if (p.x() > 1 - 1e-9) return "right";
    if (p.y() < 1e-9 || p.y() > 1 - 1e-9) return "walls";
    return p.x() < 0.5 ? "body_left" : "body_right";
  });
  return make_state(make_mesh(data));
}

}  // namespace

TEST_CASE("nodes between ends that a motion takes go along in derivatives") {
  for (const double floor_radius : {0.0, 8.0}) {
    CAPTURE(floor_radius);
    const MeshState state = half_ring(16, 8, floor_radius);
    const Commands commands = [&](double more) {
      MoveCommand move;
      MovingBody& body = move.bodies[0];
      body.markers = {"body"};
      body.motion.translate = GivenVector(0.3 + more, 0);
      if (floor_radius > 0) {
        body.motion.pivot = Vec2(0, -floor_radius);
        body.motion.rotate = -2 - 8 * more;
        body.motion.translate = {};
      }
      move.smooth.slide.markers = {"floor"};
      move.smooth.slide.spacing = SlideSpacing::held;
      move.smooth.tolerance = 1e-12;
      return move;
    };
    const MeshSensitivity sensitivity = check(commands, state, 1e-5);
    // Of the floor only the four ends of its two rows are independent.
    const std::string floor = "floor";
    Index independent = 0;
    for (const Index node : state.mesh.topology->markers().nodes_of(std::span(&floor, 1)))
      independent += std::ranges::binary_search(sensitivity.boundary(), node) ? 1 : 0;
    CHECK(independent == 4);
  }
}

TEST_CASE("images of nodes that a motion takes go along in derivatives") {
  const MeshState state = body_across_sides();
  const Coordinates& rest = state.mesh.coordinates;
  const std::string name = "body_left";
  const std::vector<Index> body = state.mesh.topology->markers().nodes_of(std::span(&name, 1));
  const Commands commands = [&](double more) {
    DeformCommand deform;
    deform.markers = {name};
    DisplacementTable table;
    for (const Index node : body) {
      const Vec3 by = 0.03 * wave(place_of(rest, node), 0) + more * wave(place_of(rest, node), 1.3);
      DisplacementEntry entry;
      entry.node = node;
      entry.displacement = GivenVector(by.x(), by.y());
      table.entries.push_back(entry);
    }
    deform.shape = table;
    deform.smooth.slide.periodic = {"left", "right"};
    deform.smooth.slide.fixed = {"body_right"};
    deform.smooth.tolerance = 1e-12;
    return deform;
  };
  const MeshSensitivity sensitivity = check(commands, state, 1e-5);
  Index taken = 0;
  for (Index node = 0; node < rest.size(); ++node)
    if (rest.xy(node).x() > 1 - 1e-9 && std::abs(std::abs(rest.xy(node).y() - 0.5) - 0.2) < 1e-9)
      taken += std::ranges::binary_search(sensitivity.boundary(), node) ? 0 : 1;
  CHECK(taken == 2);  // the images of the corners of the body
}

TEST_CASE("derivatives by the amplitude and the waves of a sine are those of differences") {
  for (const bool space : {false, true}) {
    CAPTURE(space);
    const MeshState state = space ? make_state(box_with_body(5, Volumes::tetrahedra))
                                  : make_state(make_mesh(square_with_hole(10, Cells::triangles)));
    SineDeformation sine;
    sine.amplitude = 0.02;
    sine.waves = 0.8;
    sine.fade = Fade::end;
    sine.fade_length = 0.4;
    if (space) {
      sine.direction = GivenVector(Vec3(1, 2, 3));
      sine.along = Vec3(1, -1, 0.5);
    }
    DeformCommand deform;
    deform.markers = {space ? "body" : "hole"};
    deform.smooth.tolerance = 1e-12;
    const auto moved = [&](double amplitude, double waves) {
      SineDeformation other = sine;
      other.amplitude += amplitude;
      other.waves += waves;
      deform.shape = other;
      return moved_by([&](double) { return deform; }, 0, state);
    };
    const Mesh mesh = moved(0, 0);
    const MeshSensitivity sensitivity(state, deform, mesh.coordinates);
    Random random(5);
    const Coordinates function = random_field(mesh.coordinates, random);
    const Coordinates on_boundary = sensitivity.transpose(function);
    const auto by = [&](SineParameter parameter) {
      return scalar_product(on_boundary, sine_velocities(*mesh.topology, state.mesh.coordinates,
                                                         deform.markers, sine, parameter));
    };
    const auto value = [&](double amplitude, double waves) {
      return scalar_product(function, moved(amplitude, waves).coordinates);
    };
    const double step = 1e-5;
    const double by_amplitude = (value(step, 0) - value(-step, 0)) / (2 * step);
    const double by_waves = (value(0, step) - value(0, -step)) / (2 * step);
    CHECK(by(SineParameter::amplitude) == doctest::Approx(by_amplitude).epsilon(1e-6));
    CHECK(by(SineParameter::waves) == doctest::Approx(by_waves).epsilon(1e-6));
  }
}

TEST_CASE("each of two bodies has derivatives of its own by its angle and its shift") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::mixed)));
  MoveCommand move;
  move.smooth.tolerance = 1e-12;
  move.bodies.resize(2);
  move.bodies[0].markers = {"hole_a"};
  move.bodies[0].motion.rotate = 12;
  move.bodies[0].motion.pivot = GivenVector(0.3, 0.5);
  move.bodies[1].markers = {"hole_b"};
  move.bodies[1].motion.rotate = -6;
  move.bodies[1].motion.pivot = GivenVector(0.7, 0.4);
  move.bodies[1].motion.translate = GivenVector(0.02, -0.01);
  const auto moved = [&](std::size_t body, double turn, double shift) {
    MoveCommand other = move;
    RigidMotion& motion = other.bodies[body].motion;
    motion.rotate += turn;
    motion.translate.x() += shift;
    return moved_by([&](double) { return other; }, 0, state);
  };
  const Mesh mesh = moved(0, 0, 0);
  const MeshSensitivity sensitivity(state, move, mesh.coordinates);
  Random random(5);
  const Coordinates function = random_field(mesh.coordinates, random);
  const Coordinates on_boundary = sensitivity.transpose(function);
  for (std::size_t body = 0; body < 2; ++body) {
    CAPTURE(body);
    const auto by = [&](MotionParameter parameter) {
      return scalar_product(on_boundary, parameter_velocities(mesh, move.bodies[body], parameter));
    };
    const auto difference = [&](double turn, double shift) {
      return scalar_product(function, moved(body, turn, shift).coordinates) -
             scalar_product(function, moved(body, -turn, -shift).coordinates);
    };
    const double angle = 1e-3, way = 1e-5;
    CHECK(by(MotionParameter::rotate) ==
          doctest::Approx(difference(angle, 0) / (2 * angle)).epsilon(1e-6));
    CHECK(by(MotionParameter::translate_x) ==
          doctest::Approx(difference(0, way) / (2 * way)).epsilon(1e-6));
  }
}

TEST_CASE("a surface mesh has no motion, and so no derivative by its boundary") {
  const MeshState state =
      make_state(make_mesh(lifted(square(6, Cells::triangles), [](const Vec2& p) {
        return Vec3(p.x(), p.y(), 0.1 * p.x() * p.y());
      })));
  MoveCommand move;
  move.bodies[0].markers = {"left"};
  move.bodies[0].motion.translate = GivenVector(Vec3(0.1, 0, 0));
  CHECK_THROWS_WITH_AS(MeshSensitivity(state, move, state.mesh.coordinates),
                       doctest::Contains("this is a surface mesh"), UsageError);
  CHECK_THROWS_WITH_AS(MeshSensitivity(state, SmoothCommand{}, state.mesh.coordinates),
                       doctest::Contains("no motion moves its boundary"), UsageError);
  MeshState plane = make_state(make_mesh(square_with_hole(10, Cells::triangles)));
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.translate = GivenVector(0.02, 0);
  move.how.smooth_after = false;
  CHECK_THROWS_WITH_AS(MeshSensitivity(plane, move, plane.mesh.coordinates),
                       doctest::Contains("only the boundary moves"), UsageError);
}

}  // namespace winslow::test
