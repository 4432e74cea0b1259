#include "gui/widgets/controls.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <sstream>

#include "gui/menu/user_command.h"
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

namespace {

/// The tooltip of a widget on which the mouse rests; none: it has none.
std::optional<WidgetMap::Rect> tooltip_of(Rig& rig, const std::string& widget) {
  const auto rect = rig.bench->widgets().find(widget);
  REQUIRE(rect.has_value());
  rig.move(rect->centre());
  rig.frames(20);
  return rig.bench->widgets().find("tooltip");
}

}  // namespace

TEST_CASE("a tooltip covers neither its widget nor the rows beside it") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  const Layout& layout = rig.bench->layout();
  for (const char* widget : {"marker/flap", "solver/advanced", "section/motion", "solver/method"}) {
    INFO(widget);
    const auto tip = tooltip_of(rig, widget);
    if (std::string(widget) == "section/motion") {
      CHECK_FALSE(tip.has_value());
      continue;
    }
    REQUIRE(tip.has_value());
    CHECK(tip->min.x() >= static_cast<double>(layout.left.x + layout.left.width));
  }
  for (const char* widget : {"tab/view", "quality/before"}) {
    INFO(widget);
    const auto tip = tooltip_of(rig, widget);
    REQUIRE(tip.has_value());
    CHECK(tip->max.x() <= static_cast<double>(layout.right.x));
  }
  // Of the toolbar: below it.
  const auto tip = tooltip_of(rig, "tool/fit");
  REQUIRE(tip.has_value());
  CHECK(tip->min.y() >= rig.bench->widgets().find("tool/fit")->max.y());
}

TEST_CASE("every tooltip waits for the mouse to rest") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  rig.move(rig.bench->widgets().find("tool/fit")->centre());
  rig.frames(3);
  CHECK_FALSE(rig.visible("tooltip"));
  rig.frames(20);
  CHECK(rig.visible("tooltip"));
  rig.move(rig.bench->widgets().find("tool/palette")->centre());
  rig.frames(3);
  CHECK_FALSE(rig.visible("tooltip"));
}

TEST_CASE("lines are broken at spaces, never amid a number") {
  Rig rig;
  rig.frames();  // a font is chosen
  const std::string text = "64 columns, 0 cut short, up to 0.07973 thick\nat (1.25, -3.5)";
  for (const float width : {40.0f, 90.0f, 133.0f, 250.0f, 1000.0f}) {
    CAPTURE(width);
    const std::string broken = ui::with_line_breaks(text, width);
    REQUIRE(broken.size() == text.size());
    for (std::size_t k = 0; k < text.size(); ++k)
      CHECK((broken[k] == text[k] || (broken[k] == '\n' && text[k] == ' ')));
    CHECK(broken.find("0.07973") != std::string::npos);
    std::istringstream lines(broken);
    for (std::string line; std::getline(lines, line);) {
      const bool one_word = line.find(' ') == std::string::npos;
      CHECK((one_word || ImGui::CalcTextSize(line.c_str()).x <= width));
    }
  }
  const std::string wide = ui::with_line_breaks(text, 1000);
  CHECK(wide == text);
  CHECK(std::ranges::count(ui::with_line_breaks(text, 133), '\n') > 2);
}

}  // namespace winslow::gui::test
