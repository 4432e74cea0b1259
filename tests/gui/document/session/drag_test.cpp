#include <doctest/doctest.h>

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "gui/document/session/session.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Largest distance of a marker's nodes from where a motion should have taken them.
double error_of_marker(const Mesh& before, const Mesh& after, const std::string& marker,
                       const RigidMotion& motion) {
  double error = 0;
  for (Index node : before.topology->markers().nodes(*before.topology->markers().find(marker)))
    error = std::max(
        error,
        (transform(motion, before.coordinates.xy(node)) - after.coordinates.xy(node)).norm());
  return error;
}

const MoveCommand& last_move(const Rig& rig) {
  const History& history = rig.document().history();
  return std::get<MoveCommand>(history.command(history.position()));
}

}  // namespace

TEST_CASE("dragging a body moves its boundary by exactly the drag and repairs the mesh") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  const ScreenPoint from = rig.pixel(Vec2(0, 0));
  const ScreenPoint to = from + ScreenVector(37, -23);
  const Vec2 by(37 * rig.bench->view_control().camera().units_per_pixel(),
                23 * rig.bench->view_control().camera().units_per_pixel());
  rig.drag(from, to);
  CHECK(rig.session().dragging());
  rig.release();
  CHECK_FALSE(rig.session().dragging());
  REQUIRE(rig.settle());

  REQUIRE(rig.document().history().size() == 2);
  CHECK(last_move(rig).bodies[0].markers == std::vector<std::string>{"flap"});
  CHECK(last_move(rig).bodies[0].motion.rotate == 0);
  CHECK((last_move(rig).bodies[0].motion.translate.head<2>() - by).norm() < 1e-12);
  const Mesh& after = rig.mesh();
  CHECK(after.topology == before.topology);
  CHECK(error_of_marker(before, after, "flap", {0, Vec2(0, 0), by}) < 1e-12);
  CHECK(error_of_marker(before, after, "farfield", {}) == 0);
  CHECK(check_validity(*after.topology, after.coordinates).inverted == 0);
  CHECK(rig.document().history().result(1).converged);
  const Index inner = after.topology->interior_nodes().front();
  CHECK((after.coordinates.xy(inner) - before.coordinates.xy(inner)).norm() > 1e-3);
}

TEST_CASE("the mesh follows while the body is still held") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(40, 0));
  const double by = 40 * rig.bench->view_control().camera().units_per_pixel();
  const Index node = before.topology->markers().nodes(rig.marker("flap"))[0];
  const bool followed = rig.wait([&] {
    const double moved = rig.session().coordinates().xy(node).x() - before.coordinates.xy(node).x();
    return std::abs(moved - by) < 1e-9 && rig.session().mesh().work().body_drag()->settled();
  });
  CHECK(followed);
  CHECK(rig.session().mesh().work().body_drag()->reach() == BodyDrag::Reach::there);
  const Index inner = before.topology->interior_nodes().front();
  CHECK((rig.session().coordinates().xy(inner) - before.coordinates.xy(inner)).norm() > 1e-3);
  CHECK(check_validity(*before.topology, rig.session().coordinates()).inverted == 0);
  CHECK(rig.document().history().size() == 1);
  rig.release();
  CHECK(rig.settle());
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("Esc cancels a drag and puts the mesh back") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(50, 10));
  REQUIRE(rig.wait([&] { return rig.session().coordinates() != before.coordinates; }));
  rig.key(keys::escape);
  CHECK_FALSE(rig.session().dragging());
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 1);
  CHECK(rig.session().coordinates() == before.coordinates);
}

TEST_CASE("the ring turns the selection about its pivot by the angle the mouse goes round") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click(rig.pixel(Vec2(0, 0)));
  REQUIRE(rig.session().selection().contains(rig.marker("flap")));
  const Mesh before = rig.mesh();
  const Gizmo gizmo = rig.gizmo();
  // From the knob at 45 degrees to 75 degrees on the ring.
  const double end = radians(75);
  const ScreenPoint target =
      gizmo.centre + gizmo.ring_radius * ScreenVector(std::cos(end), -std::sin(end));
  rig.drag(*gizmo.knob, target, 8);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion motion = last_move(rig).bodies[0].motion;
  CHECK(motion.rotate == doctest::Approx(30).epsilon(1e-6));
  CHECK(motion.translate.norm() < 1e-12);
  CHECK(motion.pivot->norm() < 1e-12);
  CHECK(error_of_marker(before, rig.mesh(), "flap", motion) < 1e-12);
}

TEST_CASE("a drag shows valid meshes while held, and takes the steps chosen when let go") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::EditMotionOptions{whole(MotionOptions{8, true})});
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(60, 0));
  REQUIRE(rig.session().mesh().work().body_drag() != nullptr);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(last_move(rig).how.increments == 8);
  CHECK(rig.document().history().result(1).increments == 8);
}

TEST_CASE("in the direct mode the boundary goes at once, and the job shows what the solver has") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::EditMotionOptions{whole(MotionOptions{1, true})});
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(60, 0));
  CHECK(rig.session().mesh().work().body_drag() == nullptr);
  REQUIRE(rig.session().job().active());
  CHECK(std::get<MoveCommand>(rig.session().job().command()).how.increments == 1);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(last_move(rig).how.increments == 1);
}

TEST_CASE("a mesh that is solved under the mouse is what the command gives") {
  Rig rig;
  rig.open(ring_mesh());
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(40, 0));
  REQUIRE(rig.wait([&] { return rig.session().mesh().work().body_drag()->settled(); }));
  const Coordinates held = rig.session().coordinates();
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  double change = 0;
  for (Index i = 0; i < held.size(); ++i)
    change = std::max(change, (rig.mesh().coordinates.xy(i) - held.xy(i)).norm());
  CHECK(change < 1e-8);
  CHECK(last_move(rig).how.increments == 0);
  CHECK(rig.document().history().result(1).converged);
}

TEST_CASE("a drag stops where the mesh can go no further, and says so") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0.2, 0)));
  REQUIRE(rig.wait([&] { return rig.session().mesh().work().body_drag()->settled(); }));
  const Image there = rig.bench->pictures().picture();
  // Through the far field.
  rig.move(rig.pixel(Vec2(0.2, 0)) + ScreenVector(600, 0));
  REQUIRE(rig.wait(
      [&] { return rig.session().mesh().work().body_drag()->reach() == BodyDrag::Reach::limit; }));
  CHECK(check_validity(*before.topology, rig.session().coordinates()).inverted == 0);
  rig.frames();
  CHECK(rig.bench->pictures().picture().rgba != there.rgba);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.document().history().result(1).inverted == 0);
  CHECK(rig.document().history().result(1).fraction_reached == 1);
  const double gone = last_move(rig).bodies[0].motion.translate.x();
  CHECK(gone > 0.15);
  CHECK(gone < 3);
  CHECK(error_of_marker(before, rig.mesh(), "flap", last_move(rig).bodies[0].motion) < 1e-9);
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::partial_motion);
  const std::string& text = rig.session().messages().banner()->text;
  CHECK(text.starts_with("Blocked by \"farfield\" after "));
  CHECK(text.find(" % of the drag: the body is where it got to.") != text.npos);
}

TEST_CASE("a typed motion that ends on the way is recorded as far as it got") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(40, 0)}});
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.document().history().result(1).inverted == 0);
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::partial_motion);
  const std::string& text = rig.session().messages().banner()->text;
  CHECK(text.starts_with("Blocked by \"farfield\" after "));
  CHECK(text.find(" % of the motion: the body is where it got to") != text.npos);
  CHECK(last_move(rig).bodies[0].motion.translate.x() < 4);
  CHECK(error_of_marker(before, rig.mesh(), "flap", last_move(rig).bodies[0].motion) < 1e-9);
  // A shift that was cut short has not become a turn by a rounding error.
  CHECK(last_move(rig).bodies[0].motion.rotate == 0);
  CHECK(last_move(rig).bodies[0].motion.translate.y() == 0);
  rig.click("banner/undo");
  CHECK(rig.mesh().coordinates == before.coordinates);
  CHECK(rig.session().messages().notice()->text.find("Undone: Move flap") == 0);
}

TEST_CASE(
    "a typed motion that ends before a limit of the quality says which, and gets no farther") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions regular;  // which gain more from smoothing than the motion costs
  regular.targets = TargetBlend::regular();
  rig.bench->apply(action::EditSmoothOptions{whole(regular)});
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  const auto smallest_sine = [&] {
    return measure_quality(rig.mesh()).of(Metric::normalized_jacobian).statistics.min;
  };
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(2, 0)}});
  REQUIRE(rig.settle());
  const double limit = smallest_sine() + 0.05;
  rig.bench->apply(action::Undo{});
  REQUIRE(smallest_sine() > limit);
  MotionOptions how;
  how.floor.set(Metric::normalized_jacobian, limit);
  rig.bench->apply(action::EditMotionOptions{whole(how)});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(2, 0)}});
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 3);
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::partial_motion);
  CHECK(rig.session().messages().banner()->text.starts_with(
      "Normalized Jacobian would be less than "));
  // What the mesh has come to, in figures.
  const std::string& told = rig.session().messages().banner()->text;
  const std::string now = "Worst elements now: Normalized Jacobian ";
  REQUIRE(told.find(now) != told.npos);
  CHECK(std::stod(told.substr(told.find(now) + now.size())) ==
        doctest::Approx(smallest_sine()).epsilon(1e-3));
  CHECK(smallest_sine() >= limit);
  CHECK(last_move(rig).bodies[0].motion.translate.x() > 0.1);
  CHECK(last_move(rig).bodies[0].motion.translate.x() < 2);
}

TEST_CASE("what a banner says wraps in a narrow window, above its buttons and within its strip") {
  Rig rig(1280, 720);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(40, 0)}});
  REQUIRE(rig.settle());
  for (const int width : {3400, 1100, 800}) {
    INFO("width ", width);
    rig.resize(width, 720);
    rig.frames(4);
    const auto text = rig.bench->widgets().find("banner");
    const auto button = rig.bench->widgets().find("banner/keep");
    REQUIRE(text.has_value());
    REQUIRE(button.has_value());
    const Area& v = rig.bench->layout().viewport;
    CHECK(text->max.x() <= v.x + v.width);
    CHECK(button->max.x() <= v.x + v.width);
    CHECK(button->shown);
    const bool beside = text->max.x() <= button->min.x();
    CHECK((beside || text->max.y() <= button->min.y()));
    CHECK(beside == (width == 3400));
  }
}

TEST_CASE("a second drag before the first has converged adds to it") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions slow;
  slow.formulation = Formulation::pointwise;
  slow.outer = OuterMethod::picard;
  slow.damping = 0.01;
  slow.max_iterations = 4000;
  rig.bench->apply(action::EditSmoothOptions{whole(slow)});
  const Mesh before = rig.mesh();
  const double unit = rig.bench->view_control().camera().units_per_pixel();
  rig.drag(rig.pixel(Vec2(0, 0)), rig.pixel(Vec2(0, 0)) + ScreenVector(30, 0));
  rig.release();
  // So little damping that the first is far from done when the second starts.
  const Index node = before.topology->markers().nodes(rig.marker("flap"))[0];
  REQUIRE(rig.wait([&] {
    const Vec2 moved = rig.session().coordinates().xy(node) - before.coordinates.xy(node);
    return std::abs(moved.x() - 30 * unit) < 1e-9;
  }));
  REQUIRE(rig.session().job().active());
  const ScreenPoint on_body = rig.pixel(rig.session().selection().pivot() - Vec2(0.35, 0));
  rig.drag(on_body, on_body + ScreenVector(0, -20));
  rig.bench->apply(action::EditSmoothOptions{whole(SmoothOptions{})});
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion total{0, Vec2(0, 0), Vec2(30 * unit, 20 * unit)};
  CHECK(error_of_marker(before, rig.mesh(), "flap", total) < 1e-9);
}

TEST_CASE("typed numbers move the selection on Apply") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  const Mesh before = rig.mesh();
  rig.fill("motion/dx", "0.25");
  rig.fill("motion/dy", "-0.125");
  rig.fill("motion/rotate", "-20");
  rig.fill("motion/pivot_x", "0.4");
  rig.click("motion/apply");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion wanted{-20, Vec2(0.4, 0), Vec2(0.25, -0.125)};
  CHECK(same_motion(last_move(rig).bodies[0].motion, wanted));
  CHECK(error_of_marker(before, rig.mesh(), "flap", wanted) < 1e-12);
  CHECK(error_of_marker(before, rig.mesh(), "farfield", {}) == 0);
}

TEST_CASE("two selected bodies move together") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click("marker/left");
  rig.input.key(keys::control, true);
  rig.click("marker/right");
  rig.input.key(keys::control, false);
  const Mesh before = rig.mesh();
  rig.fill("motion/dy", "0.2");
  rig.click("motion/apply");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion wanted{0, Vec2(0, 0), Vec2(0, 0.2)};
  CHECK(error_of_marker(before, rig.mesh(), "left", wanted) < 1e-12);
  CHECK(error_of_marker(before, rig.mesh(), "right", wanted) < 1e-12);
  CHECK(error_of_marker(before, rig.mesh(), "outer", {}) == 0);
}

TEST_CASE("a motion that cannot work leaves an inverted mesh, says so and can be undone") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  // Straight through the far field: no mesh of this connectivity is valid.
  rig.bench->apply(action::EditMotionOptions{whole(MotionOptions{1, true})});
  SmoothOptions quick;
  quick.max_iterations = 5;
  rig.bench->apply(action::EditSmoothOptions{whole(quick)});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(4, 0)}});
  REQUIRE(rig.settle());
  rig.frames();
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::inverted_result);
  CHECK(rig.document().history().result(1).inverted > 0);
  REQUIRE(rig.visible("banner/undo"));
  rig.click("banner/undo");
  CHECK(rig.mesh().coordinates == before.coordinates);
  CHECK_FALSE(rig.session().messages().banner().has_value());
}

TEST_CASE("while a body is dragged, bar and solver say so") {
  Rig rig;
  rig.open(ring_mesh());
  CHECK(activity_of(rig.session()).kind == Activity::Kind::idle);
  const ScreenPoint body = rig.pixel(Vec2(0, 0));
  rig.drag(body, body + ScreenVector(25, 0));
  REQUIRE(rig.session().dragging());
  CHECK(activity_of(rig.session()).kind == Activity::Kind::busy);
  const std::string text = activity_of(rig.session()).text;
  CHECK((text.starts_with("Dragging") || text.starts_with("Updating mesh...")));
  // The mesh is where the mouse wants it, and the body is held still.
  REQUIRE(rig.wait(
      [&] { return rig.session().mesh().work().body_drag()->reach() == BodyDrag::Reach::there; }));
  CHECK(activity_of(rig.session()).text.starts_with("Dragging"));
  rig.release();
  REQUIRE(rig.settle());
  CHECK(activity_of(rig.session()).kind == Activity::Kind::idle);
}

}  // namespace winslow::gui::test
