#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// How far the left body came along x.
double way_of(const Rig& rig, const Mesh& before) {
  const Index node = before.topology->markers().nodes(*before.topology->markers().find("left"))[0];
  return rig.session().coordinates().xy(node).x() - before.coordinates.xy(node).x();
}

}  // namespace

TEST_CASE(
    "a fast drag into another body shows valid meshes on the way, and keeps the last on release") {
  const Mesh before = two_body_mesh(4);
  Rig rig;
  rig.open(before);
  const double asked = 4;  // to the middle of the right body: they touch after 3
  rig.drag(rig.pixel(Vec2(-2, 0)), rig.pixel(Vec2(asked - 2, 0)), 3);
  const auto reach = [&] { return rig.session().mesh().body_drag()->reach(); };
  // Long before it is known how far the body can go.
  REQUIRE(rig.wait([&] {
    CHECK(check_validity(*before.topology, rig.session().coordinates()).inverted == 0);
    return way_of(rig, before) > 0 && rig.bench->pane().mesh_view().shown()->shape > 0;
  }));
  CHECK(reach() == BodyDrag::Reach::catching_up);
  REQUIRE(rig.wait([&] { return reach() == BodyDrag::Reach::limit; }));
  const BodyDrag::Frame& frame = rig.session().mesh().body_drag()->frame();
  CHECK(frame.share == doctest::Approx(way_of(rig, before) / asked).epsilon(1e-6));
  REQUIRE(frame.contact);
  CHECK(describe_touch(*frame.contact) == "left would touch right");
  const double held = way_of(rig, before);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(way_of(rig, before) > held - 1e-6);
  CHECK(check_validity(*before.topology, rig.mesh().coordinates).inverted == 0);
  const auto& banner = rig.session().messages().banner();
  REQUIRE(banner);
  CHECK(banner->text.starts_with("Blocked by \"right\" after "));
  MoveCommand command;
  command.markers = {"left"};
  command.motion.translate = {asked, 0};
  const CommandResult path = execute(command, make_state(before));
  CHECK(held > 0.9 * asked * path.smooth.fraction_reached);
}

TEST_CASE("a drag that is let go while the mesh is on its way goes as far as it can") {
  const Mesh before = two_body_mesh(4);
  Rig rig;
  rig.open(before);
  rig.drag(rig.pixel(Vec2(-2, 0)), rig.pixel(Vec2(2, 0)), 3);
  REQUIRE(rig.wait([&] { return way_of(rig, before) > 0; }, 60));
  const double shown = way_of(rig, before);
  rig.release();
  double least = shown;
  while (rig.session().in_motion()) {
    rig.frames(1);
    least = std::min(least, way_of(rig, before));
  }
  REQUIRE(rig.settle());
  CHECK(least > 0.99 * shown);
  CHECK(way_of(rig, before) > 0.99 * shown);
  REQUIRE(rig.document().history().size() == 2);
  REQUIRE(rig.session().messages().banner());
  // How far it came of what was asked, not of what was left when the mouse let go.
  const std::string& text = rig.session().messages().banner()->text;
  const std::string told = "Blocked by \"right\" after ";
  REQUIRE(text.starts_with(told));
  const double asked = (rig.pixel(Vec2(2, 0)) - rig.pixel(Vec2(-2, 0))).norm() *
                       rig.bench->view_control().camera().units_per_pixel();
  CHECK(std::stod(text.substr(told.size())) ==
        doctest::Approx(100 * way_of(rig, before) / asked).epsilon(0.01));
}

}  // namespace winslow::gui::test
