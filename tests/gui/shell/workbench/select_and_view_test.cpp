#include <doctest/doctest.h>

#include <cmath>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("a click selects the body under the mouse, inside it or on its rim") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click(rig.pixel(Vec2(-2, 0)));
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("left")});
  rig.click(rig.pixel(Vec2(2.5, 0.1)) + ScreenVector(3, 0));
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  CHECK((rig.session().selection().pivot() - Vec2(2, 0)).norm() < 1e-12);
  // On the elements, away from everything: nothing.
  rig.click(rig.pixel(Vec2(0.1, 0.1)));
  CHECK(rig.session().selection().empty());
}

TEST_CASE("Ctrl+click adds to the selection and takes away") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click(rig.pixel(Vec2(-2, 0)));
  rig.input.key(keys::control, true);
  rig.click(rig.pixel(Vec2(2, 0)));
  CHECK(rig.session().selection().markers().size() == 2);
  rig.click(rig.pixel(Vec2(-2.3, 0.3)));
  rig.input.key(keys::control, false);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
}

TEST_CASE("hovering lights a body up, and leaving it puts it out") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.move(rig.pixel(Vec2(2, 0)));
  rig.frames();
  CHECK(rig.session().selection().hovered() == std::vector<Index>{rig.marker("right")});
  const Image lit = rig.bench->pictures().picture();
  rig.move(rig.pixel(Vec2(0, 0)));
  rig.frames();
  CHECK(rig.session().selection().hovered().empty());
  CHECK(rig.bench->pictures().picture().rgba != lit.rgba);
}

TEST_CASE("the list of markers selects, and shows who moves") {
  Rig rig;
  rig.open(two_body_mesh());
  const Image before = rig.bench->pictures().picture();
  rig.click("marker/right");
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  rig.click("marker/left");
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("left")});
  CHECK(rig.bench->pictures().picture().rgba != before.rgba);
}

TEST_CASE("dragging the pivot puts it elsewhere without moving anything") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  const Mesh before = rig.mesh();
  const Vec2 target(0.5, 0.25);
  const ScreenPoint pin = *rig.gizmo().pin;
  rig.drag(pin, rig.pixel(target));
  rig.release();
  CHECK((rig.session().selection().pivot() - target).norm() < 1e-9);
  CHECK(rig.document().history().size() == 1);
  CHECK(rig.mesh().coordinates == before.coordinates);
  rig.click("motion/pivot_place");
  rig.click("motion/pivot_place/Centre");
  CHECK(rig.session().selection().pivot().norm() < 1e-12);
}

TEST_CASE("left drag on empty space, middle and right drag pan") {
  Rig rig;
  rig.open(ring_mesh());
  const ScreenPoint empty = rig.pixel(Vec2(1.2, 1.2));
  for (MouseButton button : {MouseButton::left, MouseButton::middle, MouseButton::right}) {
    const Vec2 world = rig.bench->view_control().camera().to_world(empty);
    rig.drag(empty, empty + ScreenVector(31, -17), 5, button);
    rig.release(button);
    CHECK((rig.bench->view_control().camera().to_screen(world) - (empty + ScreenVector(31, -17)))
              .norm() < 1e-6);
    rig.key(keys::f);
  }
  CHECK(rig.document().history().size() == 1);
}

TEST_CASE("the wheel zooms at the cursor, F shows everything") {
  Rig rig;
  rig.open(ring_mesh());
  const ScreenPoint at = rig.pixel(Vec2(0.8, 0.9));
  const Vec2 world = rig.bench->view_control().camera().to_world(at);
  const double before = rig.bench->view_control().camera().units_per_pixel();
  rig.wheel(at, 3);
  CHECK(rig.bench->view_control().camera().units_per_pixel() < 0.7 * before);
  CHECK((rig.bench->view_control().camera().to_world(at) - world).norm() < 1e-9);
  rig.key(keys::f);
  const Bounds seen = rig.bench->view_control().camera().visible();
  CHECK(seen.min.x() <= -3);
  CHECK(seen.max.y() >= 3);
}

TEST_CASE("the wheel over a panel does not zoom the mesh") {
  Rig rig;
  rig.open(ring_mesh());
  const double before = rig.bench->view_control().camera().units_per_pixel();
  rig.wheel(rig.bench->widgets().find("solver/max_iterations")->centre(), 2);
  CHECK(rig.bench->view_control().camera().units_per_pixel() == before);
}

TEST_CASE("Shift+F shows the selection") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click("marker/right");
  rig.move(rig.pixel(Vec2(0, 0)));
  rig.key(keys::f, {keys::shift});
  CHECK((rig.bench->view_control().camera().centre() - Vec2(2, 0)).norm() < 1e-9);
  CHECK(rig.bench->view_control().camera().visible().size().x() < 6);
}

TEST_CASE("Esc closes an open list or menu, and only that") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.click("menu/Edit");
  rig.frames(2);
  CHECK(rig.visible("menu/undo"));
  rig.key(keys::escape);
  rig.frames(2);
  CHECK_FALSE(rig.visible("menu/undo"));
  rig.click("tab/view");
  rig.click("view/style");
  rig.frames(2);
  CHECK(rig.visible("view/style/Edges"));
  rig.key(keys::escape);
  rig.frames(2);
  CHECK_FALSE(rig.visible("view/style/Edges"));
  CHECK(rig.session().selection().markers().size() == 1);
  // The dialog stays that the list belongs to.
  rig.key(keys::o, {keys::control});
  rig.frames(3);
  rig.click("dialog/filter");
  rig.frames(2);
  rig.key(keys::escape);
  rig.frames(2);
  CHECK(rig.bench->dialogs().file_dialog().is_open());
  rig.key(keys::escape);
  rig.frames(2);
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("colouring by quality changes the pixels of the mesh, and the legend shows it") {
  Rig rig;
  rig.open(ring_mesh());
  REQUIRE(rig.settle());
  const Image colored = rig.bench->pictures().picture();
  ViewOptions plain = rig.bench->view_control().options();
  plain.color.reset();
  plain.wireframe = false;
  rig.bench->apply(action::EditView{whole(plain)});
  REQUIRE(rig.settle());
  rig.frames();
  const Image bare = rig.bench->pictures().picture();
  const ScreenPoint p = rig.pixel(Vec2(-1.4, -0.6));
  const auto x = static_cast<int>(p.x());
  const auto y = static_cast<int>(p.y());
  const auto* before = colored.pixel(x, y);
  const auto* after = bare.pixel(x, y);
  const int difference = std::abs(before[0] - after[0]) + std::abs(before[1] - after[1]) +
                         std::abs(before[2] - after[2]);
  CHECK(difference > 60);
  CHECK(std::abs(after[0] - after[1]) < 12);  // plain elements are grey
}

TEST_CASE("the colour of elements is chosen in the view panel") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.click("tab/view");
  rig.click("view/color");
  rig.click("view/color/" + std::string(metric_label(Metric::aspect_ratio)));
  REQUIRE(rig.bench->view_control().options().color.has_value());
  CHECK(*rig.bench->view_control().options().color == Metric::aspect_ratio);
  REQUIRE(rig.settle());
  CHECK(rig.session().quality().latest()->field == Metric::aspect_ratio);
}

TEST_CASE("inverted elements are red") {
  Rig rig;
  rig.open(tangled_mesh());
  REQUIRE(rig.settle());
  rig.frames();
  const Mesh& mesh = rig.mesh();
  const auto& report = rig.session().quality().latest()->report;
  REQUIRE(report.inverted > 0);
  int red = 0;
  const Image image = rig.bench->pictures().picture();
  for (Index e : report.inverted_elements) {
    Vec2 centre(0, 0);
    for (Index node : mesh.topology->element(e)) centre += mesh.coordinates.xy(node) / 3.0;
    const ScreenPoint p = rig.pixel(centre);
    const auto* c = image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
    red += c[0] > 150 && c[1] < 90 && c[2] < 90;
  }
  CHECK(red > 0);
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::inverted_input);
}

TEST_CASE("a click on one of the worst elements shows it") {
  Rig rig(1280, 900);
  rig.open(ring_mesh());
  REQUIRE(rig.settle());
  rig.frames();
  const auto& worst =
      rig.session().quality().latest()->report.of(Metric::normalized_jacobian).worst;
  REQUIRE_FALSE(worst.empty());
  rig.click("quality/worst/0");
  const Bounds seen = rig.bench->view_control().camera().visible();
  CHECK((seen.centre() - worst[0].centre.head<2>()).norm() < 0.2 * seen.size().norm());
  CHECK(seen.size().x() < 10);
}

TEST_CASE("the pivot of a symmetric body is written as it is read") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  CHECK(rig.session().selection().pivot() == Vec2(0, 0));
}

TEST_CASE("panels can be hidden, and the mesh takes their room") {
  Rig rig;
  rig.open(ring_mesh());
  const float before = rig.bench->layout().viewport.width;
  rig.key(keys::f2);
  CHECK(rig.bench->layout().viewport.width > before + 100);
  CHECK_FALSE(rig.visible("solver/step_n"));
  rig.key(keys::f2);
  CHECK(rig.bench->layout().viewport.width == before);
}

TEST_CASE("a splitter makes a panel wider") {
  Rig rig(1600, 720);
  rig.open(ring_mesh());
  const float before = rig.bench->layout().left.width;
  const ScreenPoint grip = rig.bench->widgets().find("splitter/left")->centre();
  rig.drag(grip, grip + ScreenVector(40, 0));
  rig.release();
  CHECK(rig.bench->layout().left.width == doctest::Approx(before + 40).epsilon(0.02));
}

TEST_CASE("a click on a menu does not reach the mesh behind it") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("menu/File");
  REQUIRE(rig.visible("menu/save_as"));
  rig.click("menu/save_as");
  CHECK(rig.bench->dialogs().file_dialog().is_open());
  CHECK(rig.session().selection().empty());
}

TEST_CASE("F1 lists the keys") {
  Rig rig;
  rig.key(keys::f1);
  rig.frames();
  REQUIRE(rig.visible("help/close"));
  rig.click("help/close");
  rig.frames();
  CHECK_FALSE(rig.visible("help/close"));
}

}  // namespace winslow::gui::test
