#include "core/motion/contact.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Names = std::vector<std::string>;

/// Holes at x in [0.2, 0.4] and [0.6, 0.8], both at y in [0.4, 0.6].
Mesh plate_with_holes(Cells cells = Cells::triangles) {
  return make_mesh(square_with_two_holes(20, cells));
}

std::optional<Contact> contact_of(const Mesh& mesh, const Names& names, const RigidMotion& motion) {
  return find_contact(*mesh.topology, mesh.coordinates,
                      *make_motion(*mesh.topology, mesh.coordinates, names, motion));
}

std::optional<Contact> contact_of(const Mesh& mesh, const Names& names,
                                  const SineDeformation& shape) {
  return find_contact(*mesh.topology, mesh.coordinates,
                      *make_motion(*mesh.topology, mesh.coordinates, names, shape));
}

}  // namespace

TEST_CASE("a body that moves straight on touches the next one where their outlines meet") {
  const Mesh mesh = plate_with_holes();
  // Face to face, and shifted so that corners run into faces.
  for (const double shift : {0.0, 0.013, 0.1}) {
    CAPTURE(shift);
    const auto contact = contact_of(mesh, {"hole_a"}, {0, Vec2(0, 0), Vec2(0.5, shift)});
    REQUIRE(contact);
    CHECK(contact->fraction == doctest::Approx(0.4).epsilon(1e-5));
    CHECK(contact->edges.moving == "hole_a");
    CHECK(contact->edges.other == "hole_b");
    CHECK(contact->edges.place.x() == doctest::Approx(0.6).epsilon(1e-3));
  }
  const auto outer = contact_of(mesh, {"hole_a"}, {0, Vec2(0, 0), Vec2(-0.8, 0)});
  REQUIRE(outer);
  CHECK(outer->fraction == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(outer->edges.other == "outer");
  CHECK(describe(*outer) == "hole_a would touch outer at 25 % of the way");
}

TEST_CASE("a motion that keeps clear has no contact") {
  const Mesh mesh = plate_with_holes();
  CHECK_FALSE(contact_of(mesh, {"hole_a"}, {0, Vec2(0, 0), Vec2(0.199, 0)}));
  CHECK_FALSE(contact_of(mesh, {"hole_a"}, {720, Vec2(0.3, 0.5), Vec2(0, 0)}));
  CHECK_FALSE(contact_of(mesh, {"hole_a"}, {0, Vec2(0, 0), Vec2(0, 0)}));
  CHECK_FALSE(contact_of(mesh, {"hole_a", "hole_b"}, {0, Vec2(0, 0), Vec2(0.15, 0.3)}));
}

TEST_CASE("a turning corner touches at the angle at which it reaches the other outline") {
  const Mesh mesh = plate_with_holes();
  const Vec2 pivot(0.05, 0.5);
  const auto contact = contact_of(mesh, {"hole_a"}, {90, pivot, Vec2(0, 0)});
  REQUIRE(contact);
  // Its corner at (0.2, 0.6) is the first to reach the left side, x = 0.
  const double start = std::atan2(0.1, 0.15), end = std::acos(-0.05 / std::hypot(0.15, 0.1));
  CHECK(contact->fraction == doctest::Approx((end - start) / (pi / 2)).epsilon(1e-5));
  CHECK(contact->edges.other == "outer");
}

TEST_CASE("a body is not jumped over on a long way") {
  const Mesh mesh = plate_with_holes();
  const auto contact = contact_of(mesh, {"hole_a"}, {0, Vec2(0, 0), Vec2(50, 0)});
  REQUIRE(contact);
  CHECK(contact->edges.other == "hole_b");
  CHECK(contact->fraction == doctest::Approx(0.2 / 50).epsilon(1e-3));
}

TEST_CASE("an outline that changes its shape touches the other outline, or itself") {
  const Mesh mesh = plate_with_holes();
  SineDeformation wave;
  wave.direction = Vec2(0, 1);
  wave.waves = 0.5;
  wave.amplitude = 0.5;
  const auto other = contact_of(mesh, {"hole_a"}, wave);
  REQUIRE(other);
  CHECK(other->edges.other == "outer");
  CHECK(other->fraction == doctest::Approx(0.8).epsilon(1e-3));

  DisplacementTable pinch;  // the middle of the lower face through the upper one
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    if ((mesh.coordinates.xy(node) - Vec2(0.3, 0.4)).norm() < 1e-9)
      pinch.entries.push_back({node, {0, 0}, Vec2(0.02, 0.3), 0});
  REQUIRE(pinch.entries.size() == 1);
  const auto self = find_contact(*mesh.topology, mesh.coordinates,
                                 *make_motion(*mesh.topology, mesh.coordinates, {"hole_a"}, pinch));
  REQUIRE(self);
  CHECK(self->edges.other == "hole_a");
  CHECK(self->fraction == doctest::Approx(2.0 / 3).epsilon(1e-3));
  CHECK(describe(*self).starts_with("hole_a would touch itself at 66.7 %"));
}

TEST_CASE("a part of an outline may move while its neighbours stay") {
  const Mesh mesh = make_mesh(square(10, Cells::quads));
  CHECK_FALSE(contact_of(mesh, {"bottom"}, {0, Vec2(0, 0), Vec2(0, 0.05)}));
  // Its ends slide along the sides and meet their next nodes.
  const auto contact = contact_of(mesh, {"bottom"}, {0, Vec2(0, 0), Vec2(0, 0.5)});
  REQUIRE(contact);
  CHECK(contact->fraction == doctest::Approx(0.2).epsilon(1e-5));
}

TEST_CASE("the smallest gap is that of the nearest edges") {
  const Mesh mesh = plate_with_holes();
  const auto nodes = mesh.topology->markers().nodes_of(std::vector<std::string>{"hole_a"});
  const auto gap = smallest_gap(*mesh.topology, mesh.coordinates, nodes);
  REQUIRE(gap);
  CHECK(gap->width == doctest::Approx(0.2));
  CHECK(gap->edges.moving == "hole_a");
  Coordinates near = mesh.coordinates;
  make_motion(*mesh.topology, near, {"hole_a"}, RigidMotion{0, Vec2(0, 0), Vec2(0.15, 0.02)})
      ->apply(mesh.coordinates, 1, near);
  const auto smaller = smallest_gap(*mesh.topology, near, nodes);
  REQUIRE(smaller);
  CHECK(smaller->width == doctest::Approx(0.05));
  CHECK(smaller->edges.other == "hole_b");
  CHECK(describe(*smaller) == "hole_a is 0.05 from hole_b there");
  const auto all =
      mesh.topology->markers().nodes_of(std::vector<std::string>{"hole_a", "hole_b", "outer"});
  CHECK_FALSE(smallest_gap(*mesh.topology, mesh.coordinates, all));
}

TEST_CASE("a motion into another body is not begun, or ends with a good mesh before it") {
  const MeshState state = make_state(plate_with_holes());
  MoveCommand command;
  command.bodies[0].markers = {"hole_a"};
  command.bodies[0].motion.translate = Vec2(0.5, 0.03);
  RunOptions whole;
  whole.all_or_nothing = true;
  const CommandResult refused = execute(command, state, whole);
  REQUIRE(refused.smooth.contact);
  CHECK(refused.smooth.contact->edges.other == "hole_b");
  CHECK(refused.smooth.fraction_reached == 0);
  CHECK(refused.smooth.outer_iterations == 0);
  CHECK_FALSE(refused.smooth.converged);
  CHECK(refused.state.mesh.coordinates == state.mesh.coordinates);

  const CommandResult partial = execute(command, state);
  CHECK(partial.smooth.inverted == 0);
  CHECK(partial.smooth.converged);
  CHECK(partial.smooth.fraction_reached > 0.2);
  CHECK(partial.smooth.fraction_reached < 0.4);
  CHECK(why_incomplete(partial.smooth) == "hole_a would touch hole_b at 40 % of the way");
  const auto sine = [](const Mesh& mesh) {
    return check_validity(*mesh.topology, mesh.coordinates, 1).min_sine;
  };
  CHECK(sine(partial.state.mesh) > 0.05 * sine(state.mesh));
}

namespace {

std::unique_ptr<Motion> motion_of(const Mesh& mesh, const std::vector<MovingBody>& bodies) {
  return make_motion(*mesh.topology, mesh.coordinates, bodies);
}

}  // namespace

TEST_CASE("bodies that move together touch each other where their arcs meet") {
  const Mesh mesh = plate_with_holes();
  const auto contact_between = [&](const RigidMotion& a, const RigidMotion& b) {
    return find_contact(*mesh.topology, mesh.coordinates,
                        *motion_of(mesh, {{{"hole_a"}, a}, {{"hole_b"}, b}}));
  };
  const auto by = [](double x, double y) { return RigidMotion{.translate = Vec2(x, y)}; };
  const auto meeting = contact_between(by(0.3, 0.01), by(-0.3, 0));
  REQUIRE(meeting);
  CHECK(meeting->fraction == doctest::Approx(1.0 / 3).epsilon(1e-5));
  CHECK(describe_touch(meeting->edges) == "hole_a would touch hole_b");
  CHECK(meeting->edges.place.x() == doctest::Approx(0.5).epsilon(1e-3));
  // One that would run into the other gives way to nothing, but the other goes on as well.
  CHECK(contact_between(by(0.3, 0), by(0, 0)));
  CHECK_FALSE(contact_between(by(0.3, 0), by(0.15, 0)));
  CHECK_FALSE(contact_between(by(0.3, 0.3), by(-0.3, -0.3)));
  // So fast that they have passed through each other long before the first look at all of them.
  const auto fast = contact_between(by(60, 0.01), by(-60, 0));
  REQUIRE(fast);
  CHECK(fast->fraction == doctest::Approx(1.0 / 600).epsilon(1e-3));
  CHECK(describe_touch(fast->edges) == "hole_a would touch hole_b");
  // The rest of the boundary is in the way as it is of one body.
  const auto outer = contact_between(by(-0.8, 0), by(0, 0.1));
  REQUIRE(outer);
  CHECK(outer->fraction == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(outer->edges.other == "outer");
}

TEST_CASE("bodies that change places touch in the middle of the way, however clear its ends are") {
  const Mesh mesh = plate_with_holes();
  const Vec2 middle(0.5, 0.5);
  const auto half_turn = [&](double of_a, double of_b) {
    return motion_of(mesh,
                     {{{"hole_a"}, {of_a, middle, {0, 0}}}, {{"hole_b"}, {of_b, middle, {0, 0}}}});
  };
  // Both go below: their inner corners meet there when each has turned by 45 degrees.
  const auto below = find_contact(*mesh.topology, mesh.coordinates, *half_turn(180, -180));
  REQUIRE(below);
  CHECK(below->fraction == doctest::Approx(0.25).epsilon(1e-4));
  CHECK(describe_touch(below->edges) == "hole_a would touch hole_b");
  CHECK(below->edges.place.x() == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(below->edges.place.y() == doctest::Approx(0.5 - 0.1 * std::sqrt(2.0)).epsilon(1e-3));
  // Where they end nothing touches, and if one goes below and one above they never meet.
  CHECK_FALSE(find_contact(*mesh.topology, mesh.coordinates, *half_turn(180, 180)));
  // In the middle of the way of each alone stands the other.
  CHECK(contact_of(mesh, {"hole_a"}, {180, middle, {0, 0}}));
}

TEST_CASE("the smallest gap of several bodies is also that between them") {
  const Mesh mesh = make_mesh(square_with_two_holes(10, Cells::quads));
  const auto motion = motion_of(mesh, {{{"hole_a"}, {.translate = Vec2(0.05, 0)}},
                                       {{"hole_b"}, {.translate = Vec2(-0.05, 0)}}});
  Coordinates x = mesh.coordinates;
  motion->apply(mesh.coordinates, 1, x);
  const auto gap = smallest_gap(*mesh.topology, x, *motion);
  REQUIRE(gap);
  CHECK(gap->width == doctest::Approx(0.1));
  CHECK(describe(*gap) == "hole_a is 0.1 from hole_b there");
}
