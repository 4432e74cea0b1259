#include <doctest/doctest.h>

#include <algorithm>

#include "core/motion/rigid_motion.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

void select_flap(Rig& rig) {
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
}

void type_into(Rig& rig, const std::string& field, const std::string& text) {
  rig.click(field);
  rig.key(keys::a, {keys::control});
  rig.type(text);
}

}  // namespace

TEST_CASE("Enter in a field of the motion applies it") {
  Rig rig;
  select_flap(rig);
  type_into(rig, "motion/rotate", "25");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).motion.rotate == 25);
  // Tab applies nothing, and Enter takes both fields.
  type_into(rig, "motion/dx", "0.1");
  rig.key(keys::tab);
  rig.frames(4);
  CHECK(rig.document().history().size() == 2);
  type_into(rig, "motion/dy", "0.2");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 3);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(2));
  CHECK(move.motion.translate == Vec2(0.1, 0.2));
}

TEST_CASE("a motion is drawn as an outline while it is typed") {
  Rig rig;
  select_flap(rig);
  CHECK_FALSE(rig.session().selection().motion_preview());
  type_into(rig, "motion/dx", "0.75");
  rig.frames(2);
  const auto& preview = rig.session().selection().motion_preview();
  REQUIRE(preview.has_value());
  const auto box = [](const auto& edges) {
    double most = -1e9;
    for (const auto& [a, b] : edges) most = std::max({most, a.x(), b.x()});
    return most;
  };
  CHECK(box(preview->outline) == doctest::Approx(0.5 + 0.75));  // the ellipse ends at 0.5
  CHECK(rig.document().history().size() == 1);
  type_into(rig, "motion/dx", "0");
  rig.frames(2);
  CHECK_FALSE(rig.session().selection().motion_preview());
  type_into(rig, "motion/rotate", "10");
  rig.frames(2);
  CHECK(rig.session().selection().motion_preview());
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.session().selection().motion_preview());
}

TEST_CASE("numbers typed while the ring is dragged turn the body by just that") {
  Rig rig;
  select_flap(rig);
  const Gizmo gizmo = rig.gizmo();
  rig.drag(gizmo.knob(), gizmo.knob() + ScreenVector(-9, -5));
  REQUIRE(rig.session().dragging());
  rig.type("30");
  CHECK(rig.session().mesh().live_motion()->rotate == 30);
  rig.move(gizmo.knob() + ScreenVector(-40, -9));  // the mouse no longer counts
  CHECK(rig.session().mesh().live_motion()->rotate == 30);
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).motion.rotate == 30);
  CHECK(describe(rig.document().history().command(1)) == "Rotate flap by 30 deg");
}

TEST_CASE("numbers typed while a body is moved are x, Tab, y; Backspace takes them back") {
  Rig rig;
  select_flap(rig);
  const ScreenPoint from = rig.pixel(Vec2(-0.3, 0));  // beside the arrows
  rig.drag(from, from + ScreenVector(14, 0));
  REQUIRE(rig.session().dragging());
  rig.type("0.15");
  rig.key(keys::tab);
  rig.type("-.1");
  CHECK(rig.session().mesh().live_motion()->translate == Vec2(0.15, -0.1));
  for (int k = 0; k < 3; ++k) rig.key(GLFW_KEY_BACKSPACE);
  CHECK(rig.session().mesh().live_motion()->translate == Vec2(0.15, 0));
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.motion.translate == Vec2(0.15, 0));
}

TEST_CASE("a number typed in one frame, with Enter, is the number that counts") {
  Rig rig;
  select_flap(rig);
  const Gizmo gizmo = rig.gizmo();
  rig.drag(gizmo.knob(), gizmo.knob() + ScreenVector(-9, -5));
  for (const char32_t c : U"12.5")
    if (c != 0) rig.input.text(c);
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).motion.rotate == 12.5);
}

}  // namespace winslow::gui::test
