#include "gui/view/navigation/view_control.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "gui/support/meshes.h"

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
  v.control.apply(action::LookAt{Vec2(2, 0), 1});
  CHECK_FALSE(v.frame());
  CHECK((v.control.camera().centre() - Vec2(2, 0)).norm() < 1e-12);
  CHECK(v.control.state().can_go_back);
  v.control.apply(action::BackView{});
  CHECK(v.control.camera().centre().norm() < 1e-12);
}

TEST_CASE("What one goes to is shown above a card that lies in the middle of the view") {
  Viewed v;
  v.frame();
  v.control.apply(action::LookAt{Vec2(2, 0), 1});
  const double before = v.control.camera().to_screen(Vec2(2, 0)).y();
  v.control.set_card(ScreenBox{{0, 400}, {700, 600}});
  v.control.apply(action::LookAt{Vec2(2, 0), 1});
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

}  // namespace winslow::gui::test
