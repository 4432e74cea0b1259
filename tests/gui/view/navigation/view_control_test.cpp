#include "gui/view/navigation/view_control.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "gui/support/meshes.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/view/navigation/navigator.h"

namespace winslow::gui::test {

namespace {

/// A session with a mesh, and a view of it 800 by 600 pixels large.
struct Viewed {
  Viewed() {
    session.apply(FileAction(action::OpenMesh{write(folder, two_body_mesh())}));
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!session.document() || session.working()) {
      session.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      REQUIRE(std::chrono::steady_clock::now() < end);
    }
    control.scale().set_window(1440, 900);
  }
  bool frame() { return control.begin_frame(0, 0, 800, 600); }

  TemporaryFolder folder;
  Session session;
  ViewControl control{session, 1};
};

}  // namespace

TEST_CASE("A mesh that was opened is shown whole, once") {
  Viewed v;
  CHECK(v.frame());
  CHECK(v.control.camera().centre().norm() < 1e-12);
  CHECK(v.control.camera().visible().size().x() == doctest::Approx(8 / 0.9));
  v.control.navigator().apply(action::LookAt{Vec3(2, 0, 0), 1});
  CHECK_FALSE(v.frame());
  CHECK((v.control.camera().centre() - Vec2(2, 0)).norm() < 1e-12);
  CHECK(v.control.state().can_go_back);
  v.control.navigator().apply(action::BackView{});
  CHECK(v.control.camera().centre().norm() < 1e-12);
}

TEST_CASE("What one goes to is shown above a card that lies in the middle of the view") {
  Viewed v;
  v.frame();
  v.control.navigator().apply(action::LookAt{Vec3(2, 0, 0), 1});
  const double before = v.control.camera().to_screen(Vec2(2, 0)).y();
  v.control.navigator().set_card(ScreenBox{{0, 400}, {700, 600}});
  v.control.navigator().apply(action::LookAt{Vec3(2, 0, 0), 1});
  CHECK(before == doctest::Approx(300));
  CHECK(v.control.camera().to_screen(Vec2(2, 0)).y() == doctest::Approx(200));
}

TEST_CASE("The magnifier is pinned where the mouse is, or to the middle, and put away") {
  Viewed v;
  v.frame();
  v.control.set_mouse(v.control.camera().to_screen(Vec2(1, 1)));
  v.control.apply(action::PinMagnifier{});
  REQUIRE(v.control.options().magnifier.pin);
  CHECK((*v.control.options().magnifier.pin)[0] == doctest::Approx(1));
  v.control.release_magnifier();  // pinned: it stays
  CHECK(v.control.options().magnifier.on);
  v.control.apply(action::PinMagnifier{});
  CHECK_FALSE(v.control.options().magnifier.on);
  v.control.set_mouse(std::nullopt);
  v.control.apply(action::PinMagnifier{});
  CHECK((*v.control.options().magnifier.pin)[0] == doctest::Approx(0));
}

TEST_CASE("The divider stays within the view") {
  Viewed v;
  v.control.move_divider(0.2);
  CHECK(v.control.options().divider == doctest::Approx(0.7));
  v.control.move_divider(5);
  CHECK(v.control.options().divider == doctest::Approx(0.98));
}

TEST_CASE("A scale for which the window has no room is not stepped to") {
  Viewed v;
  v.control.apply(action::StepScale{1});
  CHECK(v.control.options().scale == 1.1);
  v.control.scale().set_window(760, 480);
  v.control.apply(action::StepScale{1});
  CHECK(v.session.messages().notice()->text == "This window has no room for a larger interface");
  v.control.apply(action::StepScale{0});
  CHECK(v.control.options().scale == 0);
}

namespace {

/// Long enough for a view to count.
void rest(Rig& rig) { rig.frames(20); }

double distance(const Camera& a, const Camera& b) {
  return (a.centre() - b.centre()).norm() / b.units_per_pixel() +
         std::abs(a.units_per_pixel() / b.units_per_pixel() - 1);
}

}  // namespace

TEST_CASE("Z and a drag zoom to the box, once") {
  Rig rig;
  rig.open(ring_mesh());
  const Vec2 from(1, 0.5);
  const Vec2 to(2, 1.2);
  const ScreenPoint corner(rig.pixel(from).x(), rig.pixel(to).y());
  const ScreenPoint across(rig.pixel(to).x(), rig.pixel(from).y());
  const Image plain = rig.bench->pictures().picture();
  rig.key(keys::z);
  CHECK(rig.bench->view_control().state().box_zoom_armed);
  rig.drag(rig.pixel(from), rig.pixel(to));
  const Image band = rig.bench->pictures().picture();
  rig.release();
  CHECK((rig.bench->view_control().camera().centre() - Vec2(1.5, 0.85)).norm() < 0.02);
  const Bounds seen = rig.bench->view_control().camera().visible();
  CHECK(std::min(seen.size().x() / 1.0, seen.size().y() / 0.7) == doctest::Approx(1).epsilon(0.03));
  CHECK_FALSE(rig.bench->view_control().state().box_zoom_armed);
  CHECK(rig.document().history().size() == 1);
  CHECK(rig.session().selection().empty());
  const ScreenVector size = across - corner;
  CHECK(differing(plain, band, corner, across) > 0.9 * size.x() * size.y());
  CHECK(differing(plain, band, corner - ScreenVector(60, 0),
                  across - ScreenVector(size.x() + 10, 0)) == 0);
  // The next drag pans again.
  const double units = rig.bench->view_control().camera().units_per_pixel();
  rig.drag(rig.pixel(Vec2(1.5, 0.9)), rig.pixel(Vec2(1.6, 0.9)));
  rig.release();
  CHECK(rig.bench->view_control().camera().units_per_pixel() == units);
}

TEST_CASE("Control and the right button draw the box at any time; Esc and a click leave the view") {
  Rig rig;
  rig.open(ring_mesh());
  const Camera start = rig.bench->view_control().camera();
  rig.key(keys::z);
  rig.key(keys::escape);
  CHECK_FALSE(rig.bench->view_control().state().box_zoom_armed);
  rig.key(keys::z);
  rig.click(rig.pixel(Vec2(1.5, 1)));
  CHECK(distance(rig.bench->view_control().camera(), start) == 0);
  rig.input.key(keys::control, true);
  rig.drag(rig.pixel(Vec2(-2, -1)), rig.pixel(Vec2(-1, 0)), 4, MouseButton::right);
  rig.release(MouseButton::right);
  rig.input.key(keys::control, false);
  rig.frames();
  CHECK((rig.bench->view_control().camera().centre() - Vec2(-1.5, -0.5)).norm() < 0.02);
}

TEST_CASE("the toolbar's arrows go back to the view before and forward again") {
  Rig rig(1200, 750);
  rig.open(two_body_mesh());
  rest(rig);
  const Camera whole = rig.bench->view_control().camera();
  const auto enabled = [&](const char* id) { return rig.bench->widgets().find(id)->enabled; };
  CHECK_FALSE(enabled("tool/view_back"));
  CHECK_FALSE(enabled("tool/view_forward"));
  rig.click("marker/right");
  rig.key(keys::f, {keys::shift});
  rest(rig);
  const Camera right = rig.bench->view_control().camera();
  REQUIRE(distance(whole, right) > 0.1);
  CHECK(enabled("tool/view_back"));
  rig.click("tool/view_back");
  CHECK(distance(rig.bench->view_control().camera(), whole) < 1e-9);
  CHECK(enabled("tool/view_forward"));
  rig.click("tool/view_forward");
  CHECK(distance(rig.bench->view_control().camera(), right) < 1e-9);
  CHECK_FALSE(enabled("tool/view_forward"));
  // The last of the row is on screen, too.
  for (const int width : {1100, 1131, 1300}) {
    rig.resize(width, 750);
    rig.frames();
    CHECK(rig.bench->widgets().find("tool/palette")->max.x() < width);
  }
}

TEST_CASE("Alt+Left goes back through the views that rested, Alt+Right forward") {
  Rig rig;
  rig.open(two_body_mesh());
  rest(rig);
  const Camera whole = rig.bench->view_control().camera();
  rig.click("marker/right");
  rig.key(keys::f, {keys::shift});
  rest(rig);
  const Camera right = rig.bench->view_control().camera();
  REQUIRE(distance(whole, right) > 0.1);
  // Passed through without a rest: one step, not five.
  for (int i = 0; i < 5; ++i) rig.wheel(rig.pixel(Vec2(2.7, 0.7)), 1);
  const Camera close = rig.bench->view_control().camera();
  rig.key(GLFW_KEY_LEFT, {GLFW_KEY_LEFT_ALT});
  CHECK(distance(rig.bench->view_control().camera(), right) < 1e-9);
  rig.key(GLFW_KEY_LEFT, {GLFW_KEY_LEFT_ALT});
  CHECK(distance(rig.bench->view_control().camera(), whole) < 1e-9);
  rig.key(GLFW_KEY_LEFT, {GLFW_KEY_LEFT_ALT});
  CHECK(distance(rig.bench->view_control().camera(), whole) < 1e-9);
  rig.key(GLFW_KEY_RIGHT, {GLFW_KEY_LEFT_ALT});
  rig.key(GLFW_KEY_RIGHT, {GLFW_KEY_LEFT_ALT});
  CHECK(distance(rig.bench->view_control().camera(), close) < 1e-9);
  CHECK_FALSE(rig.bench->view_control().state().can_go_forward);
}

TEST_CASE("a history of views forgets what was ahead when another view is taken") {
  Camera view;
  view.set_viewport(0, 0, 100, 100);
  ViewHistory history;
  const auto look = [&](double x) {
    view.look_at(Vec2(x, 0), 0.01);
    history.observe(view.looked_at(), false, 0.1);
    history.observe(view.looked_at(), false, 1);
  };
  CHECK_FALSE(history.can_go_back(view.looked_at()));
  look(1);
  look(2);
  look(3);
  view.look_at(history.back(view.looked_at()).value());
  CHECK(view.centre().x() == 2);
  CHECK(history.can_go_forward());
  look(5);
  CHECK_FALSE(history.can_go_forward());
  view.look_at(history.back(view.looked_at()).value());
  CHECK(view.centre().x() == 2);
  // While the mouse holds the view, it does not count however long it rests.
  view.look_at(Vec2(9, 0), 0.01);
  history.observe(view.looked_at(), true, 5);
  history.observe(view.looked_at(), true, 5);
  CHECK(history.can_go_forward());
}

TEST_CASE("the magnifier shows more of what is under the mouse, the wheel sets its factor") {
  Rig rig;
  rig.open(two_body_mesh());
  set_view(rig, [](ViewOptions& view) { view.color.reset(); });
  // An edge of the mesh 3 pixels from the mouse: far from it under the lens.
  const ScreenPoint at = rig.pixel(Vec2(0.25, 0.25)) + ScreenVector(0.5, 0.5);
  rig.move(at);
  rig.frames();
  const Image plain = rig.bench->pictures().picture();
  const double units = rig.bench->view_control().camera().units_per_pixel();
  rig.key(GLFW_KEY_M);
  REQUIRE(rig.bench->view_control().options().magnifier.on);
  const Image lens = rig.bench->pictures().picture();
  const ScreenVector reach(80, 80);
  CHECK(differing(plain, lens, at - reach, at + reach) > 200);
  CHECK(differing(plain, lens, at - ScreenVector(250, 0), at - ScreenVector(200, -20)) == 0);
  // Six times larger, the lines of the grid around the cell in the middle are 6 times further out.
  const double half = 0.25 / units;
  const double line = 6 * half;
  REQUIRE(line < 115);
  const auto darkest = [&](double x) {
    double least = 1;
    // The mouse is half a pixel off the middle of the cell: three under the lens.
    for (double off = -5; off <= 2; ++off)
      least = std::min(least, brightness(lens, at + ScreenVector(x + off, 20)));
    return least;
  };
  CHECK(darkest(line) < darkest(0.5 * line) - 0.1);
  rig.wheel(at, 2);
  CHECK(rig.bench->view_control().options().magnifier.factor == doctest::Approx(6 * 1.25 * 1.25));
  CHECK(rig.bench->view_control().camera().units_per_pixel() == units);
  rig.key(GLFW_KEY_M);
  CHECK_FALSE(rig.bench->view_control().options().magnifier.on);
  rig.frames();
  CHECK(differing(plain, rig.bench->pictures().picture(), at - reach, at + reach) == 0);
}

TEST_CASE("held down, the key of the magnifier shows it for as long") {
  Rig rig;
  rig.open(ring_mesh());
  rig.move(rig.pixel(Vec2(1, 1)));
  rig.input.key(GLFW_KEY_M, true);
  rest(rig);
  CHECK(rig.bench->view_control().options().magnifier.on);
  rig.input.key(GLFW_KEY_M, false);
  rig.frames();
  CHECK_FALSE(rig.bench->view_control().options().magnifier.on);
}

TEST_CASE("a pinned magnifier stays where it is while the view moves") {
  Rig rig;
  rig.open(two_body_mesh());
  const Vec2 place(-1.5, 0.5);  // a corner of a body
  rig.move(rig.pixel(place));
  rig.key(GLFW_KEY_M, {keys::shift});
  REQUIRE(rig.bench->view_control().options().magnifier.pin.has_value());
  CHECK((Vec2((*rig.bench->view_control().options().magnifier.pin)[0],
              (*rig.bench->view_control().options().magnifier.pin)[1]) -
         place)
            .norm() < 0.05);
  rig.move(ScreenPoint(5, 5));
  const Area v = rig.bench->layout().viewport;
  const ScreenPoint min(v.x + 30, v.y + v.height - 200);
  const ScreenPoint max(v.x + 200, v.y + v.height - 40);
  const Image before = rig.bench->pictures().picture();
  const ScreenPoint grip = rig.pixel(Vec2(0, 1));
  rig.drag(grip, grip + ScreenVector(40, 13));
  rig.release();
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  // The picture around it moves, what is in it does not.
  CHECK(differing(before, rig.bench->pictures().picture(), min, max) < 60);
  CHECK(differing(before, rig.bench->pictures().picture(), ScreenPoint(v.x + 350, v.y + 100),
                  ScreenPoint(v.x + 480, v.y + 300)) > 500);
  rig.key(GLFW_KEY_M, {keys::shift});
  CHECK_FALSE(rig.bench->view_control().options().magnifier.on);
}

TEST_CASE("a pinned magnifier is in pictures of any size, one that follows the mouse is not") {
  Rig rig;
  rig.open(two_body_mesh());
  const PictureSpec spec{.size = {}, .panels = false, .legend = false};
  const Vec2 place(-1.5, 0.5);  // a corner of a body
  rig.move(rig.pixel(place));
  const Image plain = rig.bench->pictures().picture(spec);
  rig.key(GLFW_KEY_M);
  REQUIRE(rig.bench->view_control().options().magnifier.on);
  CHECK(rig.bench->pictures().picture(spec).rgba == plain.rgba);
  rig.key(GLFW_KEY_M, {keys::shift});
  REQUIRE(rig.bench->view_control().options().magnifier.pin.has_value());
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  const Area v = rig.bench->layout().viewport;
  const Image window = rig.bench->pictures().picture();
  const Image pinned = rig.bench->pictures().picture(spec);
  // Its inside, bottom left.
  const ScreenPoint min(30, v.height - 200), max(200, v.height - 40);
  CHECK(differing(plain, pinned, min, max) > 2000);
  const auto brightness_of = [](const Image& image, const ScreenPoint& from, double ratio) {
    double sum = 0;
    for (int y = 0; y < 20 * ratio; ++y)
      for (int x = 0; x < 20 * ratio; ++x) sum += brightness(image, from + ScreenVector(x, y));
    return sum / (400 * ratio * ratio);
  };
  // At eight times the size the picture is made of several pieces, and the magnifier with it.
  const double ratio = 8;
  const Image large =
      rig.bench->pictures().picture({.scale = ratio, .size = {}, .panels = false, .legend = false});
  REQUIRE(large.height > 2048 + 800);
  for (double y = min.y(); y < max.y() - 20; y += 20)
    for (double x = min.x(); x < max.x() - 20; x += 20) {
      const double shown = brightness_of(window, ScreenPoint(v.x + x, v.y + y), 1);
      CHECK(brightness_of(pinned, ScreenPoint(x, y), 1) == doctest::Approx(shown).epsilon(0.03));
      CHECK(brightness_of(large, ScreenPoint(ratio * x, ratio * y), ratio) ==
            doctest::Approx(shown).epsilon(0.05));
    }
  // The window has it still.
  rig.frames();
  CHECK(rig.bench->pictures().picture().rgba == window.rgba);
  CHECK(rig.bench->pictures().figure(false).inset.has_value());
}

}  // namespace winslow::gui::test
