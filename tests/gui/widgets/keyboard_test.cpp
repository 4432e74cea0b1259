#include <doctest/doctest.h>

#include "gui/menu/user_command.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("keys of the tabs count in the order in which the tabs stand") {
  Rig rig;
  rig.open(ring_mesh());
  double last = -1;
  for (const auto& [key, tab, name] : {std::tuple{GLFW_KEY_1, SideTab::quality, "tab/quality"},
                                       std::tuple{GLFW_KEY_2, SideTab::view, "tab/view"},
                                       std::tuple{GLFW_KEY_3, SideTab::vcv, "tab/vcv"},
                                       std::tuple{GLFW_KEY_4, SideTab::history, "tab/history"}}) {
    rig.key(key, {keys::control});
    CHECK(rig.bench->view_control().options().side_tab == tab);
    const double x = rig.bench->widgets().find(name)->centre().x();
    CHECK(x > last);
    last = x;
  }
}

TEST_CASE("Ctrl and plus enlarge the interface with Shift and without") {
  Rig rig(2400, 1600);
  rig.open(ring_mesh());
  const auto scale = [&] { return rig.bench->view_control().options().scale; };
  rig.key(GLFW_KEY_EQUAL, {keys::control});
  const double once = scale();
  CHECK(once > 1);
  rig.key(GLFW_KEY_EQUAL, {keys::control, keys::shift});  // "+" of most keyboards
  CHECK(scale() > once);
}

TEST_CASE("an open list follows the arrow keys, and Enter takes what they have come to") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  REQUIRE(rig.session().jobs().motion_options().increments == 0);
  rig.click("motion/steps");
  rig.frames();
  rig.key(GLFW_KEY_DOWN);
  rig.key(GLFW_KEY_DOWN);
  CHECK(rig.session().jobs().motion_options().increments == 0);  // nothing is taken yet
  rig.key(keys::enter);
  rig.frames();
  CHECK(rig.session().jobs().motion_options().increments == 8);
  CHECK_FALSE(rig.visible("motion/steps/8 steps"));  // the list is closed
  rig.click("motion/steps");
  rig.frames();
  rig.key(GLFW_KEY_UP);
  rig.key(keys::escape);
  CHECK(rig.session().jobs().motion_options().increments == 8);
}

TEST_CASE("characters that come in one frame all count, and those after Tab go to the next field") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  rig.click("motion/dx");
  rig.key(keys::a, {keys::control});
  const auto text = [&](const std::u32string& characters) {
    for (const char32_t c : characters) rig.input.text(c);
  };
  text(U"0.125");
  rig.input.key(keys::tab, true);
  text(U"0.5");
  rig.input.key(keys::tab, false);
  rig.input.key(keys::enter, true);
  rig.input.key(keys::enter, false);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).motion.translate ==
        Vec2(0.125, 0.5));
}

TEST_CASE("a character that is a command counts as often as it was typed in one frame") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.input.text(U']');
  rig.input.text(U']');
  rig.input.text(U']');
  rig.frames();
  REQUIRE(rig.bench->view_control().state().focus.has_value());
  const Index third = rig.bench->view_control().state().focus->id;
  rig.key(keys::escape);
  rig.input.text(U'[');
  rig.input.text(U'[');
  rig.frames();
  rig.input.text(U']');
  rig.frames();
  rig.input.text(U']');
  rig.frames();
  CHECK(rig.bench->view_control().state().focus->id == third);
}

}  // namespace winslow::gui::test
