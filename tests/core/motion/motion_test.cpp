#include "core/motion/motion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Names = std::vector<std::string>;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Coordinates applied(const Motion& motion, const Coordinates& rest, double fraction) {
  Coordinates out = rest;
  motion.apply(rest, fraction, out);
  return out;
}

Vec2 turned(const Vec2& p, const Vec2& pivot, double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  const Vec2 d = p - pivot;
  return pivot + Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y());
}

template <typename Options>
std::unique_ptr<Motion> motion_of(const Mesh& mesh, const Names& names, const Options& options) {
  return make_motion(*mesh.topology, mesh.coordinates, names, options);
}

Mesh two_holes() { return make_mesh(square_with_two_holes(20, Cells::quads)); }

}  // namespace

TEST_CASE("a rigid motion moves the nodes of its markers and no others") {
  const Mesh mesh = two_holes();
  const RigidMotion options{-90, Vec2(0.5, 0), {2, -2}};
  const auto motion = motion_of(mesh, {"hole_a", "hole_b"}, options);
  const Names names{"hole_a", "hole_b"};
  const auto expected = mesh.topology->markers().nodes_of(names);
  CHECK(std::ranges::equal(motion->nodes(), expected));
  const Coordinates out = applied(*motion, mesh.coordinates, 1);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec2 p = mesh.coordinates.xy(i);
    if (std::binary_search(expected.begin(), expected.end(), i)) {
      CHECK((out.xy(i) - (turned(p, {0.5, 0}, -90) + Vec2(2, -2))).norm() < 1e-14);
    } else {
      CHECK(out.xy(i) == p);
    }
  }
}

TEST_CASE("fractions follow the rotation, counter-clockwise positive, past a full turn too") {
  const Mesh mesh = two_holes();
  const RigidMotion options{720, Vec2(0.3, 0.4), {1, 3}};
  const auto motion = motion_of(mesh, {"hole_a"}, options);
  for (const double fraction : {0.0, 0.125, 0.3, 0.5, 1.0}) {
    CAPTURE(fraction);
    const Coordinates out = applied(*motion, mesh.coordinates, fraction);
    for (const Index i : motion->nodes()) {
      const Vec2 expected =
          turned(mesh.coordinates.xy(i), {0.3, 0.4}, 720 * fraction) + fraction * Vec2(1, 3);
      CHECK((out.xy(i) - expected).norm() < 1e-13);
    }
  }
  // A quarter turn takes +x to +y.
  const auto quarter = motion_of(mesh, {"hole_a"}, RigidMotion{90, mesh.coordinates.xy(0), {0, 0}});
  const Index node = quarter->nodes().front();
  const Vec2 d = mesh.coordinates.xy(node) - mesh.coordinates.xy(0);
  const Vec2 after = applied(*quarter, mesh.coordinates, 1).xy(node) - mesh.coordinates.xy(0);
  CHECK((after - Vec2(-d.y(), d.x())).norm() < 1e-14);
}

TEST_CASE("a pure translation is exact: no rounding through the pivot") {
  const Mesh mesh = two_holes();
  const auto motion = motion_of(mesh, {"hole_b"}, RigidMotion{0, Vec2(1e9, -3e8), {0.1, -0.7}});
  const Coordinates out = applied(*motion, mesh.coordinates, 1);
  for (const Index i : motion->nodes()) {
    CHECK(out.xy(i) == Vec2(mesh.coordinates.xy(i) + Vec2(0.1, -0.7)));
  }
  const auto none = motion_of(mesh, {"hole_b"}, RigidMotion{0, Vec2(1e9, -3e8), {0, 0}});
  CHECK(applied(*none, mesh.coordinates, 1) == mesh.coordinates);
}

TEST_CASE("a rigid motion refuses numbers that are not finite and missing markers") {
  const Mesh mesh = two_holes();
  const Names hole{"hole_a"};
  CHECK_THROWS_AS(motion_of(mesh, hole, RigidMotion{nan_value, Vec2(0, 0), {0, 0}}), UsageError);
  CHECK_THROWS_AS(motion_of(mesh, hole, RigidMotion{0, Vec2(infinity, 0), {0, 0}}), UsageError);
  CHECK_THROWS_AS(motion_of(mesh, hole, RigidMotion{0, Vec2(infinity, -infinity), {0, 0}}),
                  UsageError);
  CHECK_THROWS_AS(motion_of(mesh, hole, RigidMotion{0, Vec2(0, 0), {0, nan_value}}), UsageError);
  CHECK_THROWS_AS(motion_of(mesh, {}, RigidMotion{}), UsageError);
  CHECK_THROWS_AS(motion_of(mesh, {"wing"}, RigidMotion{}), UsageError);
  MeshData data = square(3, Cells::quads);
  data.markers.push_back({"empty", 9, {}});
  CHECK_THROWS_AS(motion_of(make_mesh(data), {"empty"}, RigidMotion{}), UsageError);
}

TEST_CASE("a sine displaces by its formula, s running across the direction") {
  const Mesh mesh = two_holes();
  // hole_a is [0.2, 0.4] by [0.4, 0.6].
  const SineDeformation up{0.03, 1.5, {0, 4}, Fade::none, 0.2};
  const auto vertical = motion_of(mesh, {"hole_a"}, up);
  for (const double fraction : {0.25, 1.0}) {
    const Coordinates out = applied(*vertical, mesh.coordinates, fraction);
    for (const Index i : vertical->nodes()) {
      const Vec2 p = mesh.coordinates.xy(i);
      const double s = (p.x() - 0.2) / 0.2;
      const Vec2 d(0, fraction * 0.03 * std::sin(2 * pi * 1.5 * s));
      CHECK((out.xy(i) - p - d).norm() < 1e-14);
    }
  }
  const SineDeformation sideways{0.02, 1, {1, 0}, Fade::none, 0.2};
  const auto horizontal = motion_of(mesh, {"hole_a"}, sideways);
  const Coordinates out = applied(*horizontal, mesh.coordinates, 1);
  for (const Index i : horizontal->nodes()) {
    const Vec2 p = mesh.coordinates.xy(i);
    // Right angles to (1, 0) is (0, -1): s runs downwards.
    const double s = (0.6 - p.y()) / 0.2;
    CHECK((out.xy(i) - p - Vec2(0.02 * std::sin(2 * pi * s), 0)).norm() < 1e-14);
  }
}

TEST_CASE("fading takes the sine smoothly to zero at the chosen ends") {
  const Mesh mesh = make_mesh(square_with_hole(40, Cells::quads));  // hole [0.4, 0.6] squared
  const auto smooth = [](double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  };
  for (const Fade fade : {Fade::none, Fade::start, Fade::end, Fade::both}) {
    const SineDeformation options{0.05, 0.75, {0, 1}, fade, 0.3};
    const auto motion = motion_of(mesh, {"hole"}, options);
    const Coordinates out = applied(*motion, mesh.coordinates, 1);
    for (const Index i : motion->nodes()) {
      const double s = (mesh.coordinates.xy(i).x() - 0.4) / 0.2;
      double f = 1;
      if (fade == Fade::start || fade == Fade::both) f *= smooth(s / 0.3);
      if (fade == Fade::end || fade == Fade::both) f *= smooth((1 - s) / 0.3);
      const double expected = 0.05 * f * std::sin(2 * pi * 0.75 * s);
      CHECK(out.xy(i).y() - mesh.coordinates.xy(i).y() == doctest::Approx(expected).epsilon(1e-9));
      if ((fade == Fade::end || fade == Fade::both) && s > 1 - 1e-9) {
        CHECK(std::abs(out.xy(i).y() - mesh.coordinates.xy(i).y()) < 1e-12);
      }
    }
  }
}

TEST_CASE("a sine refuses options that are out of range") {
  const Mesh mesh = two_holes();
  SineDeformation options{0.1, 1, {0, 1}, Fade::both, 0.2};
  Names names{"hole_a"};
  SUBCASE("amplitude") { options.amplitude = nan_value; }
  SUBCASE("waves") { options.waves = infinity; }
  SUBCASE("direction of length zero") { options.direction = {0, 0}; }
  SUBCASE("direction not finite") { options.direction = {nan_value, 1}; }
  SUBCASE("fade length zero") { options.fade_length = 0; }
  SUBCASE("fade length beyond a half") { options.fade_length = 0.51; }
  SUBCASE("fade length not a number") { options.fade_length = nan_value; }
  SUBCASE("unknown marker") { names = {"slat"}; }
  SUBCASE("no marker") { names = {}; }
  SUBCASE("no extent across the direction") {
    // Displacing the straight top along itself: every node has the same s.
    const Mesh plain = make_mesh(square(3, Cells::quads));
    CHECK_THROWS_AS(motion_of(plain, {"top"}, SineDeformation{0.1, 1, {1, 0}, Fade::none, 0.2}),
                    UsageError);
    names = {};
  }
  CHECK_THROWS_AS(motion_of(mesh, names, options), UsageError);
}

namespace {

std::string refusal_of(const Mesh& mesh, const std::vector<MovingBody>& bodies) {
  try {
    make_motion(*mesh.topology, mesh.coordinates, bodies);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("bodies move together, each along its own arc") {
  const Mesh mesh = two_holes();
  const std::vector<MovingBody> bodies{
      {{"hole_a"}, {30, std::nullopt, {0.05, 0.1}}},
      {{"hole_b"}, {-80, Vec2(0.6, 0.4), {0, 0}}},
  };
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, bodies);
  const Names names{"hole_a", "hole_b"};
  CHECK(std::ranges::equal(motion->nodes(), mesh.topology->markers().nodes_of(names)));
  CHECK(motion->bodies().size() == 2);
  for (const double fraction : {0.25, 1.0}) {
    const Coordinates together = applied(*motion, mesh.coordinates, fraction);
    Coordinates one_by_one = mesh.coordinates;
    for (const MovingBody& body : bodies)
      motion_of(mesh, body.markers, body.motion)->apply(mesh.coordinates, fraction, one_by_one);
    CHECK(together == one_by_one);
  }
  const std::vector<MovingBody> alone{bodies[1]};
  CHECK(make_motion(*mesh.topology, mesh.coordinates, alone)->bodies().empty());
}

TEST_CASE("nodes that two bodies share have to go the same way") {
  const Mesh mesh = make_mesh(square(4, Cells::quads));  // bottom and left share the corner (0, 0)
  const auto by = [](double x, double y) { return RigidMotion{.translate = Vec2(x, y)}; };
  const std::string apart =
      refusal_of(mesh, {{{"top"}, by(0, 0)}, {{"bottom"}, by(0, 0.1)}, {{"left"}, by(0.1, 0)}});
  CHECK(apart.starts_with("the markers top and left share node "));
  CHECK(
      apart.ends_with(", which their motions take to different places, 0.1 apart: make them one "
                      "body, or let both turn about that node"));
  CHECK(refusal_of(mesh, {{{"bottom"}, by(0, 0.1)}, {{"left"}, by(0, 0.1)}}) == "accepted");
  // Both hang on the corner, which is their hinge.
  const auto about = [](double degrees) { return RigidMotion{degrees, Vec2(0, 0), {0, 0}}; };
  CHECK(refusal_of(mesh, {{{"bottom"}, about(20)}, {{"left"}, about(-10)}}) == "accepted");
  // They end at one place and go there by different arcs.
  CHECK(refusal_of(mesh, {{{"bottom"}, {360, Vec2(1, 1), {0, 0}}}, {{"left"}, by(0, 0)}})
            .starts_with("the markers bottom and left share node "));
  // Four full turns are no turn at quarters of the way.
  CHECK(refusal_of(mesh, {{{"bottom"}, {4 * 360, Vec2(1, 1), {0, 0}}}, {{"left"}, by(0, 0)}})
            .starts_with("the markers bottom and left share node "));
  CHECK(refusal_of(mesh, {{{"bottom"}, by(0, 0)}, {{"left", "bottom"}, by(0, 0)}}) ==
        "the marker bottom belongs to two of the bodies that are to move");
  CHECK(refusal_of(mesh, {}) == "no body given: what is to move?");
}
