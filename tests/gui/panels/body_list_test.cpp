#include "gui/panels/panels.h"

#include <doctest/doctest.h>

#include <cmath>

#include "gui/support/moving_rig.h"

namespace winslow::gui::test {

namespace {

/// A studio with the bodies left and right.
struct ListRig : Rig {
  ListRig() : Rig(1280, 1100) {
    open(two_body_mesh(2));
    select("left");
  }
  void select(const std::string& name) {
    bench->apply(action::SelectMarkers{{marker(name)}});
    frames(3);
  }
  const BodyPlan& plan() const { return session().selection().plan(); }
  void press(const std::string& widget) {
    click(widget);
    frames(3);
  }
  void enter(const std::string& field, const std::string& text) {
    fill(field, text);
    frames(3);
  }
};

}  // namespace

TEST_CASE("bodies are listed with their motions, changed by a click, and applied together") {
  ListRig rig;
  CHECK_FALSE(rig.visible("motion/apply_all"));
  rig.enter("motion/rotate", "12");
  rig.press("motion/add_body");
  REQUIRE(rig.plan().bodies().size() == 1);
  CHECK(rig.plan().bodies()[0] == MovingBody{{"left"}, {.rotate = 12}});
  CHECK_FALSE(rig.visible("motion/apply"));
  CHECK_FALSE(rig.session().selection().motion_preview());
  // The fields of another body begin with no motion.
  rig.select("right");
  CHECK(rig.visible("motion/apply"));
  rig.enter("motion/dx", "0.25");
  rig.press("motion/add_body");
  REQUIRE(rig.plan().bodies().size() == 2);
  CHECK(rig.plan().bodies()[1] == MovingBody{{"right"}, {.translate = Vec2(0.25, 0)}});

  // What is typed for a listed body is its motion at once, pivot included.
  rig.press("motion/body/0");
  CHECK(rig.session().selection().names() == std::vector<std::string>{"left"});
  rig.enter("motion/rotate", "20");
  CHECK(rig.plan().bodies()[0] == MovingBody{{"left"}, {.rotate = 20}});
  rig.enter("motion/pivot_x", "-1.5");
  CHECK(rig.plan().bodies()[0] == MovingBody{{"left"}, {20, Vec2(-1.5, 0), {0, 0}}});
  rig.press("motion/body/1");
  CHECK(rig.session().selection().pivot() == Vec2(2, 0));
  rig.press("motion/body/0");
  CHECK(rig.session().selection().pivot() == Vec2(-1.5, 0));
  rig.key(keys::enter);
  rig.frames(4);
  CHECK(rig.document().history().size() == 1);
  CHECK(rig.plan().bodies()[1] == MovingBody{{"right"}, {.translate = Vec2(0.25, 0)}});

  rig.press("motion/apply_all");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(describe(rig.document().history().command(1)) ==
        "Rotate left by 20 deg, move right by (0.25, 0)");
  CHECK(rig.plan().empty());
  rig.frames(3);
  CHECK_FALSE(rig.visible("motion/apply_all"));
  CHECK(rig.visible("motion/apply"));
  // One undo takes all of it back, and the list returns.
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(rig.document().history().position() == 0);
  REQUIRE(rig.visible("motion/body/1"));
  CHECK(rig.plan().bodies()[0] == MovingBody{{"left"}, {20, Vec2(-1.5, 0), {0, 0}}});
}

TEST_CASE("listed bodies are taken out by their cross, or all at once") {
  ListRig rig;
  for (const char* name : {"left", "right"}) {
    rig.select(name);
    rig.enter("motion/rotate", "5");
    rig.press("motion/add_body");
  }
  REQUIRE(rig.plan().bodies().size() == 2);
  rig.press("motion/body/0/remove");
  REQUIRE(rig.plan().bodies().size() == 1);
  CHECK(rig.plan().bodies()[0].markers == std::vector<std::string>{"right"});
  // Without a selection the list stays on screen.
  rig.bench->apply(action::SelectMarkers{});
  rig.frames(3);
  CHECK(rig.visible("motion/body/0"));
  rig.press("motion/clear_bodies");
  CHECK(rig.plan().empty());
  CHECK_FALSE(rig.visible("motion/body/0"));
}

TEST_CASE("the list has commands of the menu, and another mesh empties it") {
  ListRig rig;
  const auto run = [&](const char* id) {
    rig.click("menu/Motion");
    rig.frames(3);
    rig.click(std::string("menu/") + id);
    rig.frames(4);
  };
  run("list_body");
  REQUIRE(rig.plan().bodies().size() == 1);
  CHECK_FALSE(rig.plan().moves());
  // The field of the rotation has the keyboard.
  rig.key(keys::a, {keys::control});
  rig.type("15");
  rig.key(keys::enter);
  rig.frames(4);
  CHECK(rig.plan().bodies()[0] == MovingBody{{"left"}, {.rotate = 15}});
  run("list_apply");
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.plan().empty());
  run("list_body");
  CHECK(rig.plan().bodies().size() == 1);
  run("list_clear");
  CHECK(rig.plan().empty());
  run("list_body");
  rig.bench->apply(action::OpenMesh{write(rig.folder, two_body_mesh(1), "other.su2"), true});
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 1);
  CHECK(rig.plan().empty());
}

TEST_CASE("a listed motion reads as it is done") {
  CHECK(motion_summary({}, false) == "stays");
  CHECK(motion_summary({.rotate = 12}, false) == "12\xC2\xB0 about its centre");
  CHECK(motion_summary({-30, Vec2(0.5, 0), Vec2(0.1, -2)}, false) ==
        "-30\xC2\xB0 about (0.5, 0), moves by (0.1, -2)");
  CHECK(motion_summary({10, Vec3(1, 2, 3), Vec3(0, 0, 1), Vec3(0, 1, 0)}, true) ==
        "10\xC2\xB0 about (1, 2, 3), axis (0, 1, 0), moves by (0, 0, 1)");
}

namespace {

/// A box of 5 cubes along each side with the bodies left and right, a cube each.
Mesh box_with_two_bodies() {
  namespace meshes = winslow::test;
  MeshData data = meshes::cubes_with_holes(
      5, meshes::Volumes::tetrahedra,
      [](Index i, Index j, Index k) { return j == 2 && k == 2 && (i == 1 || i == 3); });
  meshes::mark_volume(data, [](const Vec3& p) {
    if ((p - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9) return "outer";
    return p.x() < 0.5 ? "left" : "right";
  });
  return make_mesh(data);
}

}  // namespace

TEST_CASE("In space listed bodies have axes of their own, and move together") {
  MovingStudio studio(box_with_two_bodies(), "left");
  studio.resize(1280, 1300);
  studio.frames();
  const auto press = [&](const char* widget) {
    studio.click(widget);
    studio.frames(3);
  };
  studio.fill("motion/rotate", "15");
  studio.frames(3);
  press("motion/add_body");
  studio.take("right");
  studio.fill("motion/axis_x", "1");
  studio.fill("motion/axis_z", "0");
  studio.fill("motion/rotate", "-20");
  studio.fill("motion/d_z", "0.05");
  studio.frames(3);
  press("motion/add_body");
  const BodyPlan& plan = studio.session().selection().plan();
  REQUIRE(plan.bodies().size() == 2);
  CHECK(plan.bodies()[0].motion.axis == Vec3(0, 0, 1));
  CHECK(plan.bodies()[1].motion.axis == Vec3(1, 0, 0));
  CHECK_FALSE(plan.outline().empty());
  press("motion/body/0");
  CHECK(studio.session().selection().space().axis() == Vec3(0, 0, 1));
  press("motion/body/1");
  CHECK(studio.session().selection().space().axis() == Vec3(1, 0, 0));
  CHECK(plan.bodies()[0].motion.rotate == 15);
  CHECK(plan.bodies()[1].motion.rotate == -20);
  press("motion/apply_all");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == 2);
  const auto& move = std::get<MoveCommand>(studio.document().history().command(1));
  REQUIRE(move.bodies.size() == 2);
  const Coordinates& rest = studio.document().history().state(0).mesh.coordinates;
  const RigidMotion of_right{-20, Vec3(0.7, 0.5, 0.5), Vec3(0, 0, 0.05), Vec3(1, 0, 0)};
  for (const Index node : studio.mesh().topology->markers().nodes(studio.marker("right")))
    CHECK((studio.mesh().coordinates.xyz(node) - transform(of_right, rest.xyz(node))).norm() <
          1e-12);
  studio.check_replay();
  CHECK(studio.blocked("list_apply") == "No bodies are listed.");
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(studio.mesh().coordinates == rest);
  CHECK(plan.bodies().size() == 2);
}

}  // namespace winslow::gui::test
