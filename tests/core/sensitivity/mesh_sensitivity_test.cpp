#include "core/sensitivity/mesh_sensitivity.h"

#include "core/error.h"
#include "core/motion/node_table.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/polygon_meshes.h"
#include "support/sensitivities.h"
#include "support/space_meshes.h"

namespace winslow::test {
namespace {

/// A mesh, a deformation of one of its markers, and how it is carried out.
struct Case {
  std::string name;
  MeshState state;
  std::string body;
  SmoothOptions smooth = {};
  double size = 0.03;  ///< of the displacements
};

std::vector<Index> nodes_of(const Case& of) {
  return of.state.mesh.topology->markers().nodes_of(std::span(&of.body, 1));
}

/// The body bent by `size` of one wave and `more` of another.
DeformCommand bent(const Case& of, double more) {
  PositionTable table;
  const Coordinates& x = of.state.mesh.coordinates;
  for (const Index node : nodes_of(of)) {
    const Vec3 p = place_of(x, node);
    Vec3 to = p + of.size * wave(p, 0) + more * wave(p, 1.3);
    if (x.dimension() == 2) to.z() = 0;
    PositionEntry entry;
    entry.node = node;
    entry.position = x.dimension() == 2 ? GivenVector(Vec2(to.head<2>())) : GivenVector(to);
    table.entries.push_back(entry);
  }
  DeformCommand command;
  command.markers = {of.body};
  command.shape = table;
  command.smooth = of.smooth;
  command.smooth.tolerance = 1e-12;
  return command;
}

Coordinates moved_by(const Case& of, double more) {
  const CommandResult result = execute(bent(of, more), of.state);
  REQUIRE(result.smooth.converged);
  REQUIRE(result.smooth.fraction_reached == 1);
  return result.state.mesh.coordinates;
}

/// Compares forward products with central differences of whole runs, and transposes with these.
void check(const Case& of) {
  CAPTURE(of.name);
  const MeshSensitivity sensitivity(of.state, bent(of, 0), moved_by(of, 0));
  CHECK(largest_difference(sensitivity.mesh(), moved_by(of, 0)) < 1e-9);
  const Coordinates& rest = of.state.mesh.coordinates;
  Coordinates boundary(rest.dimension(), rest.size());
  for (const Index node : nodes_of(of)) set_place(boundary, node, wave(place_of(rest, node), 1.3));
  // The steps are short, because third derivatives jump where guards and weights set in.
  const Coordinates expected =
      difference_of([&](double step) { return moved_by(of, step); }, 1e-4 * of.size);
  CHECK(largest_inside(*of.state.mesh.topology, expected) > 0.1);
  CHECK(error_of(sensitivity.forward(boundary), expected) < 1e-6);
  check_transpose(sensitivity);
}

/// A cube with a cavity whose outside is a sphere.
MeshState ball_with_cavity(Index n) {
  MeshData data = cube_with_cavity(n, Volumes::tetrahedra);
  for (Index node = 0; node < data.node_count(); ++node) {
    const Vec3 p = data.coordinates.xyz(node) - Vec3::Constant(0.5);
    const double share = 2 * p.lpNorm<Eigen::Infinity>();  // 1 on the outside
    const double round = p.norm() > 0 ? p.lpNorm<Eigen::Infinity>() / p.norm() : 1;
    data.coordinates.set_xyz(node, p * (1 - share * share + share * share * round));
  }
  return make_state(make_mesh(data));
}

Case plane(std::string name, MeshData data, double size = 0.03) {
  return {std::move(name), make_state(make_mesh(data)), "hole", {}, size};
}

}  // namespace

TEST_CASE("derivatives of plane meshes by their boundary are those of differences of runs") {
  check(plane("triangles", square_with_hole(10, Cells::triangles)));
  check(plane("quadrilaterals", square_with_hole(10, Cells::quads)));
  check(plane("both", square_with_hole(10, Cells::mixed)));
  check(plane("polygons", as_polygons(square_with_hole(8, Cells::quads))));
  check(plane("quadtree", quadtree_with_hole(8)));
}

TEST_CASE("derivatives by stretched walls go through the targets of the layers over them") {
  for (const Cut cut : {Cut::none, Cut::alternating}) {
    Case layered{name_of(cut),
                 make_state(make_mesh(o_grid(32, distances(9, 0.02, 1.4, 9), cut))),
                 "wall",
                 {},
                 0.06};
    check(layered);
  }
  for (const Volumes volumes : {Volumes::prisms, Volumes::hexahedra}) {
    Case floor{name_of(volumes), make_state(layered_cube(volumes, 0.02)), "floor", {}, 0.004};
    floor.smooth.slide.fixed = {"walls"};
    check(floor);
  }
}

TEST_CASE("derivatives know elements without a shape of their own") {
  MeshData data = o_grid(32, distances(9, 0.02, 1.4, 9), Cut::alternating);
  Coordinates& x = data.coordinates;
  const Index node = 32 * 6;  // beyond the next one
  set_place(x, node, 2.2 * place_of(x, node + 1) - 1.2 * place_of(x, node));
  const Case tangled{"tangled", make_state(make_mesh(data)), "wall", {}, 0.06};
  const CommandResult result = execute(bent(tangled, 0), tangled.state);
  CHECK(result.smooth.without_shape > 0);
  check(tangled);
}

TEST_CASE("derivatives of volume meshes by their boundary are those of differences of runs") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::prisms}) {
    check({name_of(volumes), make_state(box_with_body(5, volumes)), "body", {}, 0.02});
  }
  // Polyhedra between split hexahedra, with hanging nodes.
  check({"split hexahedra", make_state(make_mesh(split_box_with_body(3))), "body", {}, 0.02});
}

TEST_CASE("derivatives know nodes that slide, and images across periodic sides") {
  Case slides{"sliding square", make_state(make_mesh(square_with_hole(10, Cells::triangles))),
              "hole"};
  slides.smooth.slide.markers = {"outer"};
  check(slides);
  Case circle{"sliding circle", make_state(make_mesh(conformal_annulus(24, 6))), "inner"};
  circle.smooth.slide.markers = {"outer"};
  check(circle);
  Case box{"sliding box",
           make_state(make_mesh(cube_with_cavity(5, Volumes::tetrahedra))),
           "cavity",
           {},
           0.02};
  box.smooth.slide.markers = {"outer"};
  check(box);
  Case ball{"sliding ball", ball_with_cavity(6), "cavity", {}, 0.02};
  ball.smooth.slide.markers = {"outer"};
  check(ball);
  Case periodic{"periodic", make_state(make_mesh(square_with_periodic_sides(10))), "hole"};
  periodic.smooth.slide.periodic = {"left", "right"};
  check(periodic);
}

TEST_CASE("derivatives by the angle and the shift of a body are those of differences of motions") {
  for (const bool space : {false, true}) {
    CAPTURE(space);
    const MeshState state =
        space ? make_state(box_with_body(5, Volumes::tetrahedra))
              : make_state(make_mesh(square_with_two_holes(12, Cells::triangles)));
    MoveCommand move;
    move.smooth.tolerance = 1e-12;
    MovingBody& body = move.bodies[0];
    body.markers = {space ? "body" : "hole_a"};
    body.motion.rotate = 8;
    body.motion.pivot = space ? GivenVector(Vec3(0.4, 0.5, 0.5)) : GivenVector(Vec2(0.3, 0.4));
    if (space) body.motion.axis = Vec3(1, 0.4, 2);
    body.motion.translate = space ? GivenVector(Vec3(0.01, 0.02, -0.01)) : GivenVector(0.01, 0.02);
    const auto moved = [&](double turn, double shift) {
      MoveCommand other = move;
      other.bodies[0].motion.rotate += turn;
      other.bodies[0].motion.translate.y() += shift;
      const CommandResult result = execute(other, state);
      REQUIRE(result.smooth.fraction_reached == 1);
      return result.state.mesh;
    };
    const Mesh mesh = moved(0, 0);
    const MeshSensitivity sensitivity(state, move, mesh.coordinates);
    Random random(5);
    const Coordinates function = random_field(mesh.coordinates, random);
    const Coordinates on_boundary = sensitivity.transpose(function);
    const auto by = [&](MotionParameter parameter) {
      return scalar_product(on_boundary, parameter_velocities(mesh, body, parameter));
    };
    const auto value = [&](double turn, double shift) {
      return scalar_product(function, moved(turn, shift).coordinates);
    };
    const double angle = 1e-3, way = 1e-5;
    const double turned = (value(angle, 0) - value(-angle, 0)) / (2 * angle);
    const double shifted = (value(0, way) - value(0, -way)) / (2 * way);
    CHECK(by(MotionParameter::rotate) == doctest::Approx(turned).epsilon(1e-6));
    CHECK(by(MotionParameter::translate_y) == doctest::Approx(shifted).epsilon(1e-6));
  }
}

TEST_CASE("a mesh far from the origin has the derivatives of one near it") {
  Case near = plane("near", square_with_hole(8, Cells::triangles));
  Case far = near;
  for (Index node = 0; node < far.state.mesh.coordinates.size(); ++node)
    far.state.mesh.coordinates.set_xy(
        node, far.state.mesh.coordinates.xy(node) + Vec2(1 << 20, -(1 << 19)));
  const auto derivative = [](const Case& of, const Case& field) {
    DeformCommand command = bent(field, 0);
    auto& entries = std::get<PositionTable>(command.shape).entries;
    const Vec3 shift =
        place_of(of.state.mesh.coordinates, 0) - place_of(field.state.mesh.coordinates, 0);
    for (PositionEntry& entry : entries)
      entry.position =
          GivenVector(Vec2(entry.position.x() + shift.x(), entry.position.y() + shift.y()));
    const Coordinates moved = execute(command, of.state).state.mesh.coordinates;
    Coordinates boundary(2, moved.size());
    for (const Index node : nodes_of(of)) boundary.set_xy(node, Vec2(1, 0.5));
    return MeshSensitivity(of.state, command, moved).forward(boundary);
  };
  CHECK(largest_difference(derivative(far, near), derivative(near, near)) < 1e-8);
}

TEST_CASE("what has no derivative is refused by name") {
  const Case plain = plane("plain", square_with_hole(8, Cells::triangles));
  const Coordinates moved = moved_by(plain, 0);
  CHECK_THROWS_WITH_AS(MeshSensitivity(plain.state, SmoothCommand{}, moved),
                       doctest::Contains("no motion"), UsageError);
  DeformCommand pointwise = bent(plain, 0);
  pointwise.smooth.formulation = Formulation::pointwise;
  CHECK_THROWS_WITH_AS(MeshSensitivity(plain.state, pointwise, moved),
                       doctest::Contains("expected the variational form"), UsageError);
  DeformCommand raised = bent(plain, 0);
  raised.smooth.raise_worst = true;
  CHECK_THROWS_WITH_AS(MeshSensitivity(plain.state, raised, moved),
                       doctest::Contains("raise_worst"), UsageError);
  const MeshSensitivity sensitivity(plain.state, bent(plain, 0), moved);
  CHECK_THROWS_WITH_AS(sensitivity.forward(Coordinates(2, 3)),
                       doctest::Contains("found vectors at 3 nodes"), UsageError);
  CHECK_THROWS_AS(sensitivity.transpose(Coordinates(3, moved.size())), UsageError);
  CHECK(sensitivity.distance() < 1e-8);
  Coordinates elsewhere = moved;
  const Index corner = nodes_of(plain)[0];
  elsewhere.set_xy(corner, elsewhere.xy(corner) + Vec2(0.01, 0));
  CHECK_THROWS_WITH_AS(MeshSensitivity(plain.state, bent(plain, 0), elsewhere),
                       doctest::Contains("of hole has moved"), UsageError);
  CHECK(sensitivity.frozen().knee > 1);
  CHECK(sensitivity.frozen().stuck_nodes == 0);
}

}  // namespace winslow::test
