#include <doctest/doctest.h>

#include "core/quality/quality.h"
#include "gui/support/moving_rig.h"

namespace winslow::gui::test {

TEST_CASE("Kept to an axis that points at the eye, a drag goes no further than the mouse says") {
  MovingStudio studio;
  for (const bool perspective : {false, true}) {
    set_view(studio, [&](ViewOptions& view) { view.space.perspective = perspective; });
    studio.key(GLFW_KEY_1);
    studio.frames();
    const ScreenPoint from = studio.handle("centre");
    studio.drag(from, from + ScreenVector(1, -1), 1);
    studio.key(GLFW_KEY_X);
    for (int k = 1; k <= 12; ++k) {
      const ScreenVector by(15 * std::cos(k), 15 * std::sin(k));
      studio.move(from + by);
      const Vec3 way = studio.live().translate;
      CHECK(way.y() == 0);
      CHECK(way.z() == 0);
      CHECK(pixels(studio, way) < 8 * by.norm());
    }
    // Up on screen is towards where the axis points.
    studio.move(from + ScreenVector(0, -10));
    CHECK(studio.live().translate.x() > 0);
    studio.key(keys::escape);
    studio.release();
    REQUIRE(studio.settle());
  }
}

TEST_CASE("Where the mesh can follow no further the mouse says by what, and the body stays there") {
  MovingStudio studio;
  const Coordinates before = studio.mesh().coordinates;
  const ScreenPoint from = studio.handle("arrow/x");
  studio.drag(from, from + ScreenVector(1, 1));
  studio.type("0.9");  // the box ends 0.4 from the body
  CHECK(studio.live().translate == Vec3(0.9, 0, 0));
  REQUIRE(studio.wait([&] {
    CHECK(check_validity(*studio.mesh().topology, studio.session().coordinates()).inverted == 0);
    return studio.session().mesh().work().body_drag()->reach() == BodyDrag::Reach::limit;
  }));
  const BodyDrag& drag = *studio.session().mesh().work().body_drag();
  REQUIRE(drag.frame().contact.has_value());
  CHECK(drag.frame().contact->other == "far");
  CHECK(drag.frame().share < 0.5);
  const double held = drag.frame().motion.translate.x();
  CHECK(held > 0.1);
  studio.key(keys::enter);
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  CHECK(studio.last_motion().translate.x() == doctest::Approx(held).epsilon(0.02));
  CHECK(studio.last_motion().translate.x() < 0.4);
  CHECK(check_validity(*studio.mesh().topology, studio.mesh().coordinates).inverted == 0);
  const auto& banner = studio.session().messages().banner();
  REQUIRE(banner);
  CHECK(banner->text.starts_with("Blocked by \"far\" after "));
  studio.check_replay();
}

TEST_CASE("A ring about a pivot far from the body takes the body around it") {
  MovingStudio studio;
  studio.bench->apply(action::SetSpacePivot{Vec3(0.5, 0.1, 0.5)});
  studio.key(GLFW_KEY_5);
  studio.key(keys::f);
  REQUIRE(studio.settle());
  studio.frames();
  const Gizmo g = studio.gizmo();
  CHECK((g.centre - studio.at({0.5, 0.1, 0.5})).norm() < 1e-9);
  const ScreenPoint from = studio.handle("ring/z");
  studio.drag(from, from);
  go_around(studio, g.centre, from, 12, 6);
  studio.follow();
  const double turned = studio.live().rotate;
  CHECK(turned == doctest::Approx(12).epsilon(1e-3));
  CHECK((studio.gizmo().centre - g.centre).norm() < 1e-6);  // it turns about itself
  studio.release();
  REQUIRE(studio.settle());
  const Coordinates& rest = studio.document().history().state(0).mesh.coordinates;
  const double angle = radians(turned);
  for (const Index node : studio.mesh().topology->markers().nodes(studio.marker("body"))) {
    const Vec3 arm = rest.xyz(node) - Vec3(0.5, 0.1, 0.5);
    const Vec3 there(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                     std::sin(angle) * arm.x() + std::cos(angle) * arm.y(), arm.z());
    CHECK((studio.mesh().coordinates.xyz(node) - Vec3(0.5, 0.1, 0.5) - there).norm() < 1e-9);
  }
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.1, 0.5)).norm() < 1e-9);
}

TEST_CASE("Drags of meshes of every kind of element, and two drags after one another") {
  for (const auto volumes : {winslow::test::Volumes::hexahedra, winslow::test::Volumes::mixed}) {
    CAPTURE(winslow::test::name_of(volumes));
    MovingStudio studio(winslow::test::box_with_body(5, volumes));
    for (int k = 1; k <= 2; ++k) {
      const ScreenPoint from = studio.handle("arrow/z");
      studio.drag(from, from + ScreenVector(0, -15));
      studio.follow();
      studio.release();
      REQUIRE(studio.settle());
      CHECK(studio.document().history().position() == static_cast<std::size_t>(k));
      CHECK(studio.document().history().result(at(k)).inverted == 0);
    }
    CHECK(studio.session().selection().space_pivot().z() > 0.5);
  }
}

}  // namespace winslow::gui::test
