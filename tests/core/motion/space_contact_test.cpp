#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/motion/contact.h"
#include "core/motion/outline.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Kind = Meeting<3>::Kind;

/// The unit cube with cavities at [1/8, 3/8] and [5/8, 7/8] in x and [3/8, 5/8] in y and z: markers
/// outer, left, right.
MeshData box_with_bodies(Volumes volumes) {
  MeshData data = cubes_with_holes(8, volumes, [](Index i, Index j, Index k) {
    const bool middle = (j == 3 || j == 4) && (k == 3 || k == 4);
    return middle && (i == 1 || i == 2 || i == 5 || i == 6);
  });
  mark_volume(data, [](const Vec3& p) {
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs();
    if (q.maxCoeff() > 0.5 - 1e-9) return "outer";
    return p.x() < 0.5 ? "left" : "right";
  });
  return data;
}

std::optional<Contact> contact_of(const Mesh& mesh, const std::vector<std::string>& names,
                                  const auto& motion) {
  return find_contact(*mesh.topology, mesh.coordinates,
                      *make_motion(*mesh.topology, mesh.coordinates, names, motion));
}

RigidMotion shift(const Vec3& by) { return {.translate = by}; }

Vec3 random_point(Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

Facet<3> random_triangle(Random& random) {
  return {random_point(random), random_point(random), random_point(random)};
}

/// Points of a triangle, its corners and sides among them.
std::vector<Vec3> samples(const Facet<3>& t, int steps) {
  std::vector<Vec3> points;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      points.push_back((i * t[0] + j * t[1] + (steps - i - j) * t[2]) / steps);
  return points;
}

/// By the 3 by 3 system of the point that a segment and a plane have in common.
bool passes(const Vec3& p, const Vec3& q, const Facet<3>& t) {
  Eigen::Matrix3d columns;
  columns << t[1] - t[0], t[2] - t[0], p - q;
  const Vec3 solution = columns.inverse() * (p - t[0]);
  return solution.minCoeff() > 0 && solution[2] < 1 && solution[0] + solution[1] < 1;
}

}  // namespace

TEST_CASE("two triangles cross where an edge of one solves the system of meeting the other") {
  Random random(7);
  int crossings = 0;
  for (int round = 0; round < 2000; ++round) {
    const Facet<3> s = random_triangle(random), t = random_triangle(random);
    bool expected = false;
    for (std::size_t k = 0; k < 3; ++k)
      expected = expected || passes(s[k], s[(k + 1) % 3], t) || passes(t[k], t[(k + 1) % 3], s);
    CAPTURE(round);
    REQUIRE((meeting(s, t).kind == Kind::crossing) == expected);
    REQUIRE((meeting(t, s).kind == Kind::crossing) == expected);
    crossings += expected;
  }
  CHECK(crossings > 100);
  CHECK(crossings < 1900);
}

TEST_CASE("the distance of two triangles is that of their nearest points") {
  Random random(11);
  constexpr int steps = 24;
  int apart = 0;
  for (int round = 0; round < 60; ++round) {
    const Facet<3> s = random_triangle(random);
    Facet<3> t = random_triangle(random);
    for (Vec3& corner : t) corner.x() += 0.5 * random.uniform();
    const double found = distance(s, t);
    double sampled = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> others = samples(t, steps);
    for (const Vec3& p : samples(s, steps))
      for (const Vec3& q : others) sampled = std::min(sampled, (p - q).norm());
    CAPTURE(round);
    // Samples are no nearer than the nearest points, and within a step of them on either side.
    CHECK(found <= sampled + 1e-12);
    CHECK(found >= sampled - 2 * 2.1 / steps);
    CHECK(found == doctest::Approx(distance(t, s)));
    apart += found > 0;
  }
  CHECK(apart > 20);
}

TEST_CASE("triangles touch at a corner, along an edge and in a plane, and are apart beside it") {
  const Facet<3> base{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto kind = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return meeting(base, Facet<3>{a, b, c}).kind;
  };
  CHECK(kind({.2, .2, 0}, {.2, .2, 1}, {.4, .2, 1}) == Kind::touch);
  CHECK(kind({.2, .2, 1e-9}, {.2, .2, 1}, {.4, .2, 1}) == Kind::none);
  CHECK(kind({.2, .2, -1e-9}, {.2, .2, 1}, {.4, .2, 1}) == Kind::crossing);
  CHECK(kind({0, 0, 0}, {1, 0, 0}, {0, -1, 0}) == Kind::touch);
  CHECK(kind({.5, .5, 1}, {.5, .5, -1}, {2, 2, 0}) == Kind::touch);
  CHECK(kind({.1, .1, 0}, {.2, .1, 0}, {.1, .2, 0}) == Kind::touch);  // one within the other
  CHECK(kind({-1, .5, 0}, {2, .5, 0}, {2, .6, 0}) == Kind::touch);    // no corner within
  CHECK(kind({2, 2, 0}, {3, 2, 0}, {2, 3, 0}) == Kind::none);
  CHECK(distance(base, Facet<3>{Vec3(.2, .2, .5), Vec3(.3, .2, .7), Vec3(.2, .3, .7)}) ==
        doctest::Approx(.5));
  CHECK(distance(base, Facet<3>{Vec3(-1, -1, 0), Vec3(-2, -1, 0), Vec3(-1, -2, 0)}) ==
        doctest::Approx(std::sqrt(2.0)));
}

TEST_CASE("a body in space touches the next one, or the outer boundary, where they meet") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(box_with_bodies(volumes));
    for (const Vec3& aside : {Vec3(0, 0, 0), Vec3(0, 0.013, 0.04), Vec3(0, 0.1, -0.1)}) {
      const auto contact = contact_of(mesh, {"left"}, shift(Vec3(0.5, 0, 0) + aside));
      REQUIRE(contact);
      CHECK(contact->fraction == doctest::Approx(0.5).epsilon(1e-5));
      CHECK(contact->edges.moving == "left");
      CHECK(contact->edges.other == "right");
      CHECK(contact->edges.place.x() == doctest::Approx(0.625).epsilon(1e-3));
      CHECK(std::abs(contact->edges.place.z() - 0.5) < 0.13);
    }
    const auto down = contact_of(mesh, {"left"}, shift({0, 0, -0.5}));
    REQUIRE(down);
    CHECK(down->fraction == doctest::Approx(0.75).epsilon(1e-5));
    CHECK(describe(*down) == "left would touch outer at 75 % of the way");
    CHECK_FALSE(contact_of(mesh, {"left"}, shift({0.249, 0, 0})));
    CHECK_FALSE(contact_of(mesh, {"left", "right"}, shift({0, 0, 0.3})));
    // The corners of its cross-section are 0.25 sqrt(1/2) = 0.177 from the axis: within 0.25.
    CHECK_FALSE(contact_of(mesh, {"left"},
                           RigidMotion{720, Vec3(0.25, 0.5, 0.5), Vec3(0, 0, 0), Vec3(1, 0, 0)}));
  }
}

TEST_CASE("a body that turns in space touches at the angle at which its corner arrives") {
  const Mesh mesh = make_mesh(box_with_bodies(Volumes::tetrahedra));
  const Vec3 pivot(0.125, 0.5, 0.375);
  const auto contact =
      contact_of(mesh, {"left"}, RigidMotion{-90, pivot, Vec3(0, 0, 0), Vec3(0, 1, 0)});
  REQUIRE(contact);
  // The edge above the pivot, 1/4 from it, reaches x = 0, 1/8 from it, at 30 degrees.
  CHECK(contact->fraction == doctest::Approx(1.0 / 3).epsilon(1e-4));
  CHECK(contact->edges.other == "outer");
}

TEST_CASE("bodies in space that change places touch in the middle of the way") {
  const Mesh mesh = make_mesh(box_with_bodies(Volumes::tetrahedra));
  const Vec3 middle(0.5, 0.5, 0.5), axis(0, 0, 1);
  const auto contact_between = [&](double of_left, double of_right) {
    const std::vector<MovingBody> bodies{{{"left"}, {of_left, middle, Vec3(0, 0, 0), axis}},
                                         {{"right"}, {of_right, middle, Vec3(0, 0, 0), axis}}};
    return find_contact(*mesh.topology, mesh.coordinates,
                        *make_motion(*mesh.topology, mesh.coordinates, bodies));
  };
  // Their inner edges meet when each has turned by 45 degrees. At the end all is clear.
  const auto contact = contact_between(180, -180);
  REQUIRE(contact);
  CHECK(contact->fraction == doctest::Approx(0.25).epsilon(1e-4));
  CHECK(describe_touch(contact->edges) == "left would touch right");
  CHECK(contact->edges.place.x() == doctest::Approx(0.5).epsilon(1e-3));
  CHECK_FALSE(contact_between(180, 180));
}

TEST_CASE("a body of a volume mesh that changes its shape touches another, or itself") {
  const Mesh mesh = make_mesh(box_with_bodies(Volumes::tetrahedra));
  SineDeformation wave;
  wave.waves = 0.5;
  wave.amplitude = 0.75;
  const auto other = contact_of(mesh, {"left"}, wave);  // upwards along y, over x
  REQUIRE(other);
  CHECK(other->edges.other == "outer");
  CHECK(other->fraction == doctest::Approx(0.5).epsilon(1e-3));

  DisplacementTable pinch;  // the middle of one face through the one opposite
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    if ((mesh.coordinates.xyz(node) - Vec3(0.25, 0.5, 0.375)).norm() < 1e-9)
      pinch.entries.push_back({node, {0, 0}, {0.01, 0.02, 0.4}, 0});
  }
  REQUIRE(pinch.entries.size() == 1);
  const auto self = contact_of(mesh, {"left"}, pinch);
  REQUIRE(self);
  CHECK(self->edges.other == "left");
  CHECK(self->fraction == doctest::Approx(0.25 / 0.4).epsilon(1e-3));
}

TEST_CASE("part of a boundary in space may move while its neighbours stay") {
  const Mesh mesh = make_mesh(cube(5, Volumes::hexahedra));
  CHECK_FALSE(contact_of(mesh, {"floor"}, shift({0, 0, 0.05})));
  const auto contact = contact_of(mesh, {"floor"}, shift({0, 0, 0.5}));
  REQUIRE(contact);  // its sides meet the next nodes of the walls
  CHECK(contact->fraction == doctest::Approx(0.4).epsilon(1e-4));
}

TEST_CASE("the smallest gap in space is that of the nearest faces") {
  const Mesh mesh = make_mesh(box_with_bodies(Volumes::hexahedra));
  const std::vector<std::string> left{"left"};
  const auto nodes = mesh.topology->markers().nodes_of(left);
  Coordinates x = mesh.coordinates;
  make_motion(*mesh.topology, x, left, shift({0.2, 0.03, 0}))->apply(mesh.coordinates, 1, x);
  const auto gap = smallest_gap(*mesh.topology, x, nodes);
  REQUIRE(gap);
  CHECK(gap->width == doctest::Approx(0.05));
  CHECK(describe(*gap) == "left is 0.05 from right there");
}

TEST_CASE("a motion in space into another body is not begun") {
  const MeshState state = make_state(make_mesh(box_with_bodies(Volumes::tetrahedra)));
  MoveCommand command;
  command.bodies[0].markers = {"left"};
  command.bodies[0].motion.translate = Vec2(0.5, 0.03);
  RunOptions whole;
  whole.all_or_nothing = true;
  const CommandResult refused = execute(command, state, whole);
  REQUIRE(refused.smooth.contact);
  CHECK(refused.smooth.contact->edges.other == "right");
  CHECK(refused.smooth.outer_iterations == 0);
  CHECK(refused.state.mesh.coordinates == state.mesh.coordinates);
}
