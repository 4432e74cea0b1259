#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/command/command.h"
#include "core/error.h"
#include "core/motion/contact.h"
#include "core/quality/quality.h"
#include "support/periodic_meshes.h"
#include "support/polygon_meshes.h"
#include "support/space_meshes.h"

/// Sliding boundaries, periodic sides and contact of meshes with polygons and polyhedra.
namespace winslow::test {
namespace {

/// Checks that two meshes with the same nodes end alike, and that the command moves the first one.
void check_same_end(const Command& command, const MeshState& by_types, const MeshState& by_faces) {
  const CommandResult expected = execute(command, by_types), found = execute(command, by_faces);
  CHECK(expected.smooth.converged);
  CHECK(found.smooth.converged);
  CHECK(found.smooth.inverted == 0);
  const Coordinates& x = found.state.mesh.coordinates;
  CHECK(largest_difference(x, by_faces.mesh.coordinates) > 1e-3);
  CHECK(largest_difference(x, expected.state.mesh.coordinates) < 1e-9);
  REQUIRE(found.smooth.boundary.sliding.size() == expected.smooth.boundary.sliding.size());
  for (std::size_t k = 0; k < found.smooth.boundary.sliding.size(); ++k)
    CHECK(found.smooth.boundary.sliding[k].nodes == expected.smooth.boundary.sliding[k].nodes);
  CHECK(found.smooth.boundary.periodic.size() == expected.smooth.boundary.periodic.size());
}

MoveCommand move_of(const std::string& marker, const RigidMotion& motion) {
  MoveCommand move;
  move.bodies[0].markers = {marker};
  move.bodies[0].motion = motion;
  return move;
}

void shake(MeshState& state, Random& random, double by) {
  for (const Index node : state.mesh.topology->interior_nodes())
    state.mesh.coordinates.set_xyz(node,
                                   state.mesh.coordinates.xyz(node) + by * random_vector(random));
}

/// A mesh in space with other places of its nodes.
MeshData mapped(MeshData data, const std::function<Vec3(const Vec3&)>& to) {
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xyz(i, to(data.coordinates.xyz(i)));
  return data;
}

double largest_distance(const Mesh& mesh, const std::string& marker, const Coordinates& x,
                        const std::function<double(const Vec3&)>& off) {
  double largest = 0;
  for (const Index node : mesh.topology->markers().nodes_of(std::vector<std::string>{marker}))
    largest = std::max(largest, std::abs(off(SpacePoints(x)[node])));
  return largest;
}

/// A ball around a body: split_box_with_body(), its outside blown up to a sphere.
MeshData split_ball_with_body(Index n) {
  return mapped(split_box_with_body(n), [](const Vec3& p) {
    const Vec3 q = 2 * p - Vec3(1, 1, 1);
    const double reach = q.cwiseAbs().maxCoeff(), length = q.norm();
    return length > 0 ? Vec3(q * (1 + reach * (reach / length - 1))) : q;
  });
}

/// A cube of hexahedra with a body in it; markers left, right (periodic), walls, body.
MeshData periodic_cube(Index n) {
  MeshData data = cubes_with_holes(
      n, Volumes::hexahedra, [&](Index i, Index j, Index k) { return i == 2 && j == 2 && k == 2; });
  mark_volume(data, [](const Vec3& p) {
    if (p.x() < 1e-9) return "left";
    if (p.x() > 1 - 1e-9) return "right";
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs();
    return q.maxCoeff() > 0.5 - 1e-9 ? "walls" : "body";
  });
  return data;
}

}  // namespace

TEST_CASE("sides slide alike under quadrilaterals and the same as polygons") {
  const MeshData data = square_with_hole(10, Cells::quads);
  std::vector<std::string> outer;
  for (const Marker& marker : data.markers)
    if (marker.name != "hole") outer.push_back(marker.name);
  MoveCommand move = move_of("hole", {.rotate = 20, .translate = Vec3(0.05, 0.02, 0)});
  move.smooth.slide.markers = outer;
  check_same_end(move, make_state(make_mesh(data)), make_state(make_mesh(as_polygons(data))));
}

TEST_CASE("periodic sides move together alike under quadrilaterals and the same as polygons") {
  const MeshData data = sector(60, 8, 6, Vec2(0.3, 0.2));
  MeshState by_types = make_state(make_mesh(data)),
            by_faces = make_state(make_mesh(as_polygons(data)));
  Random random(4), again(4);
  perturb(by_types.mesh, random, 0.3);
  perturb(by_faces.mesh, again, 0.3);
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  smooth.smooth.slide.periodic = {"begin", "end"};
  check_same_end(smooth, by_types, by_faces);
  smooth.smooth.slide.markers = {"inner", "outer"};
  check_same_end(smooth, by_types, by_faces);
}

TEST_CASE("hexahedra given by their faces slide and are periodic as by their types") {
  const MeshData data = periodic_cube(5);
  const MeshState by_types = make_state(make_mesh(data)),
                  by_faces = make_state(make_mesh(as_polyhedra(data)));
  MoveCommand move = move_of("body", {.rotate = 10, .translate = Vec3(0.05, 0.03, 0)});
  move.bodies[0].motion.axis = Vec3(0, 0.2, 1);
  for (const bool slide : {false, true}) {
    CAPTURE(slide);
    if (slide) move.smooth.slide.markers = {"walls"};
    check_same_end(move, by_types, by_faces);
    move.smooth.slide.periodic = {"left", "right"};
    check_same_end(move, by_types, by_faces);
    move.smooth.slide.periodic.clear();
  }
}

TEST_CASE("hexahedra given by their faces slide on a curved surface as by their types") {
  const auto bulge = [](const Vec3& p) {
    const double height = 1 + 0.15 * std::sin(2 * p.x() + 1) * std::cos(1.5 * p.y());
    return Vec3(p.x(), p.y(), p.z() * height);
  };
  const MeshData data = mapped(cube(6, Volumes::hexahedra), bulge);
  MeshState by_types = make_state(make_mesh(data)),
            by_faces = make_state(make_mesh(as_polyhedra(data)));
  Random random(4), again(4);
  shake(by_types, random, 0.03);
  shake(by_faces, again, 0.03);
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  smooth.smooth.slide.markers = {"lid"};
  check_same_end(smooth, by_types, by_faces);
}

TEST_CASE("faces with hanging nodes slide on what they lie on, and the way back leads back") {
  const Mesh ball = make_mesh(split_ball_with_body(6));
  MoveCommand move = move_of("body", {.rotate = 25, .pivot = Vec3(0, 0, 0)});
  move.bodies[0].motion.axis = Vec3(1, 2, 1);
  move.smooth.slide.markers = {"far"};
  move.smooth.tolerance = 1e-9;
  const CommandResult there = execute(move, make_state(ball));
  CHECK(there.smooth.converged);
  CHECK(there.smooth.inverted == 0);
  const Coordinates& x = there.state.mesh.coordinates;
  REQUIRE(there.smooth.boundary.sliding.size() == 1);
  CHECK(there.smooth.boundary.sliding[0].description == "sphere of radius 1");
  CHECK(largest_distance(ball, "far", x, [](const Vec3& p) { return p.norm() - 1; }) < 1e-12);
  double slid = 0;
  for (const Index node : ball.topology->markers().nodes_of(std::vector<std::string>{"far"}))
    slid = std::max(slid, (x.xyz(node) - ball.coordinates.xyz(node)).norm());
  CHECK(slid > 0.01);
  move.bodies[0].motion.rotate = -25;
  const CommandResult back = execute(move, there.state);
  CHECK(largest_difference(back.state.mesh.coordinates, ball.coordinates) < 1e-6);
}

TEST_CASE("a smooth surface runs through faces with hanging nodes") {
  // An ellipsoid is no sphere: a smooth surface over the triangles of the faces.
  const auto stretch = [](const Vec3& p) { return Vec3(p.x(), 0.8 * p.y(), 1.3 * p.z()); };
  const Mesh mesh = make_mesh(mapped(split_ball_with_body(8), stretch));
  MoveCommand move = move_of("body", {.rotate = 20, .pivot = Vec3(0, 0, 0)});
  move.bodies[0].motion.axis = Vec3(1, 2, 1);
  move.smooth.slide.markers = {"far"};
  const CommandResult result = execute(move, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  const auto off = [](const Vec3& p) { return Vec3(p.x(), p.y() / 0.8, p.z() / 1.3).norm() - 1; };
  CHECK(largest_distance(mesh, "far", result.state.mesh.coordinates, off) < 0.01);
  CHECK(largest_distance(mesh, "far", mesh.coordinates, off) < 1e-12);
}

TEST_CASE("polygons slide along a circle, and the way back leads back") {
  MeshData data = dual_of(make_mesh(annulus(24, 8, 1.2, Cells::triangles)));
  // The middles of edges of the boundary come onto its circles.
  for (const Marker& marker : data.markers) {
    double radius = 0;
    for (const Face& edge : marker.faces)
      for (const Index node : edge) radius = std::max(radius, data.coordinates.xy(node).norm());
    for (const Face& edge : marker.faces)
      for (const Index node : edge)
        data.coordinates.set_xy(node, radius * data.coordinates.xy(node).normalized());
  }
  const Mesh mesh = make_mesh(data);
  MoveCommand move = move_of("inner", {.rotate = 40, .pivot = Vec3(0, 0, 0)});
  move.smooth.slide.markers = {"outer"};
  move.smooth.slide.spacing = SlideSpacing::free;
  const CommandResult there = execute(move, make_state(mesh));
  CHECK(there.smooth.converged);
  CHECK(there.smooth.inverted == 0);
  // The mesh turns as a whole: then no element changes its shape.
  Coordinates turned = mesh.coordinates;
  const Eigen::Rotation2Dd rotation(radians(40.0));
  for (Index i = 0; i < turned.size(); ++i) turned.set_xy(i, rotation * mesh.coordinates.xy(i));
  CHECK(largest_difference(there.state.mesh.coordinates, turned) < 0.02);
  move.bodies[0].motion.rotate = -40;
  const CommandResult back = execute(move, there.state);
  CHECK(largest_difference(back.state.mesh.coordinates, mesh.coordinates) < 1e-6);
}

TEST_CASE("contact is found at the same place under cells by faces as by types") {
  const auto share_of = [](const MeshData& data, const std::string& marker, const Vec3& way) {
    const Mesh mesh = make_mesh(data);
    RigidMotion motion;
    motion.translate = way;
    const auto contact =
        find_contact(*mesh.topology, mesh.coordinates,
                     *make_motion(*mesh.topology, mesh.coordinates, {marker}, motion));
    REQUIRE(contact);
    return std::pair(contact->fraction, contact->edges.other);
  };
  const MeshData plane = square_with_two_holes(20, Cells::quads);
  CHECK(share_of(plane, "hole_a", Vec3(0.5, 0.02, 0)) ==
        share_of(as_polygons(plane), "hole_a", Vec3(0.5, 0.02, 0)));
  const MeshData space = periodic_cube(5);
  for (const Vec3& way : {Vec3(0.7, 0.1, 0), Vec3(0, 0.1, -0.9)})
    CHECK(share_of(space, "body", way) == share_of(as_polyhedra(space), "body", way));
}

TEST_CASE("faces with hanging nodes touch where they are, and nothing beside them") {
  // The body of split_box_with_body(6), [1/2, 2/3]^3, reaches the corner at 0 after half a unit
  // along the diagonal. Turned about, the boxes of edges are wide, and tell of no contact.
  for (const double degrees : {0.0, 25.0, 45.0}) {
    CAPTURE(degrees);
    const Eigen::AngleAxisd turn(radians(degrees), Vec3(1, 0.3, 0.7).normalized());
    const auto to = [&](const Vec3& p) -> Vec3 { return turn * p; };
    const Mesh mesh = make_mesh(mapped(split_box_with_body(6), to));
    for (const auto& [way, share] : {std::pair(Vec3(-0.8, -0.2, -0.3), 0.5 / 0.8),
                                     {Vec3(0.1, -1, 0.05), 0.5},
                                     {Vec3(-0.1, -0.1, 0.8), (1.0 / 3) / 0.8}}) {
      RigidMotion motion;
      motion.translate = turn * way;
      const auto contact =
          find_contact(*mesh.topology, mesh.coordinates,
                       *make_motion(*mesh.topology, mesh.coordinates, {"body"}, motion));
      REQUIRE(contact);
      CHECK(contact->fraction == doctest::Approx(share).epsilon(3e-3));
    }
  }
}

TEST_CASE("the surface first: of faces with up to four corners, others are refused") {
  SmoothCommand smooth;
  smooth.smooth.slide.markers = {"far"};
  smooth.smooth.slide.surface_first = true;
  MeshState split = make_state(make_mesh(split_box_with_body(6)));
  CHECK_THROWS_WITH_AS(execute(smooth, split), doctest::Contains("corners, and surface meshes"),
                       UsageError);
  const MeshData data = periodic_cube(5);
  MeshState by_types = make_state(make_mesh(data)),
            by_faces = make_state(make_mesh(as_polyhedra(data)));
  Random random(8), again(8);
  shake(by_types, random, 0.03);
  shake(by_faces, again, 0.03);
  smooth.smooth.slide.markers = {"walls"};
  smooth.smooth.targets = TargetBlend::regular();
  check_same_end(smooth, by_types, by_faces);
}

}  // namespace winslow::test
