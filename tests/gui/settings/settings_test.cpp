#include "gui/settings/settings.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "gui/settings/option_edits.h"
#include "gui/settings/picture_spec.h"
#include "gui/settings/view_state.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("settings survive being written and read") {
  Settings settings;
  settings.view.color = Metric::condition_number;
  settings.view.color_map = "cividis";
  settings.view.bands = 8;
  settings.view.color_axis = ColorAxis::logarithmic;
  settings.view.percentiles = {{5, 95}};
  settings.view.fill = false;
  settings.view.lightness = Lightness::dark;
  settings.view.backdrop = Backdrop::gradient;
  settings.view.scale = 1.5;
  settings.view.side_tab = SideTab::history;
  settings.view.markers = {
      "wing.su2",
      {{"flap", {true, false, std::nullopt}}, {"slat", {false, true, {{0.25f, 0.5f, 0.75f}}}}}};
  settings.left_width = 311;
  settings.folded = {"section/solver"};
  settings.window = {1200, 800};
  CHECK(read_settings(write_settings(settings)) == settings);
  settings.view.color.reset();
  CHECK(read_settings(write_settings(settings)) == settings);
}

TEST_CASE("settings that belong to one mesh are not kept") {
  Settings settings;
  settings.view.isolation.on = true;
  settings.view.comparison = Comparison::split;
  settings.view.range = {{0.2, 0.4}};
  settings.view.magnifier.on = true;
  CHECK(read_settings(write_settings(settings)).view == ViewOptions());
}

TEST_CASE("values that make no sense are as designed, unknown keys are kept") {
  const std::string text = R"({"view": {"bands": -3, "scale": "huge", "color_map": "jet",
      "color_axis": "square", "percentiles": [90, 10],
      "lightness": "purple", "color": "beauty", "wireframe": 1, "later": 7},
      "layout": {"left_width": -1, "window": [5, 1e9]}, "plans": ["a.su2"]})";
  const Settings settings = read_settings(text);
  CHECK(settings == Settings());
  const auto again = nlohmann::json::parse(write_settings(settings, text));
  CHECK(again["plans"][0] == "a.su2");
  CHECK(again["view"]["later"] == 7);
  CHECK(again["view"]["bands"] == 0);
  CHECK_THROWS_AS(read_settings("[1, 2"), InputError);
  CHECK_THROWS_AS(read_settings("17"), InputError);
}

TEST_CASE("settings of odd content are refused, and names that are none left out") {
  CHECK_THROWS_AS(read_settings(std::string(1000000, '[')), InputError);
  CHECK_THROWS_AS(read_settings(R"({"view": )" + std::string(1000000, '[')), InputError);
  const std::string longer(70000, 'a');
  const Settings settings =
      read_settings(R"({"recent": ["a.su2", "b\u0000.su2", ")" + longer + R"(", "c.su2"]})");
  CHECK(settings.recent == std::vector<std::string>{"a.su2", "c.su2"});
}

TEST_CASE("a second studio on the same profile looks as the first was left") {
  const TemporaryFolder home;
  const auto profile = home / "profile";
  {
    Rig rig(1600, 800, profile);
    rig.open(ring_mesh());
    rig.key(GLFW_KEY_D, {keys::control});
    const ScreenPoint grip = rig.bench->widgets().find("splitter/left")->centre();
    rig.drag(grip, grip + ScreenVector(40, 0));
    rig.release();
    rig.click("section/solver");
    rig.click("tab/view");
  }
  Rig rig(1600, 800, profile);
  CHECK(rig.bench->view_control().options().lightness == Lightness::dark);
  CHECK(rig.bench->view_control().options().side_tab == SideTab::view);
  CHECK(rig.bench->layout().left_width == doctest::Approx(332).epsilon(0.01));
  rig.open(ring_mesh());
  CHECK(rig.visible("section/solver"));
  CHECK_FALSE(rig.visible("solver/step_n"));
}

TEST_CASE("settings are written while the studio runs, once they rest") {
  const TemporaryFolder home;
  Rig rig(1280, 720, home.path());
  rig.key(GLFW_KEY_D, {keys::control});
  REQUIRE(rig.wait([&] { return std::filesystem::exists(home / "settings.json"); }));
  CHECK(text_of(home / "settings.json").find("\"dark\"") != std::string::npos);
}

TEST_CASE("a damaged settings file does no harm and is not lost") {
  const TemporaryFolder home;
  std::ofstream(home / "settings.json") << "{\"view\": {\"bands\"";
  Rig rig(1280, 720, home.path());
  CHECK(rig.bench->view_control().options() == ViewOptions());
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->kind == Notice::Kind::warning);
  CHECK(rig.session().messages().notice()->text.find("settings.json") != std::string::npos);
  CHECK(text_of(home / "settings.json.damaged") == "{\"view\": {\"bands\"");
  rig.open(ring_mesh());
  CHECK(rig.session().document() != nullptr);
}

TEST_CASE("without a profile nothing is kept") {
  const TemporaryFolder home;
  {
    SettingsFile file({});
    Settings settings;
    settings.view.bands = 5;
    for (int i = 0; i < 5; ++i) file.keep(settings, 1);
  }
  CHECK(std::filesystem::is_empty(home.path()));
}

TEST_CASE("edits of different fields made from the same options hold both, in either order") {
  const ViewOptions start;
  ViewOptions plain = start;
  plain.legend = false;
  plain.isolation.threshold = 0.25;
  ViewOptions lens = start;
  lens.magnifier.on = true;
  lens.isolation.on = true;
  ViewOptions expected = plain;
  expected.magnifier.on = true;
  expected.isolation.on = true;
  const auto one = difference(start, plain);
  const auto other = difference(start, lens);
  ViewOptions forth = start, back = start;
  one.apply_to(forth);
  other.apply_to(forth);
  other.apply_to(back);
  one.apply_to(back);
  CHECK(forth == expected);
  CHECK(back == expected);
}

TEST_CASE("an edit back to the default is an edit; an edit of nothing is empty") {
  ViewOptions start;
  start.color.reset();
  start.worst_count = 50;
  ViewOptions after = start;
  CHECK(difference(start, after).empty());
  after.color = ViewOptions().color;
  const auto edit = difference(start, after);
  CHECK_FALSE(edit.empty());
  edit.apply_to(start);
  CHECK(start.color == ViewOptions().color);
  CHECK(start.worst_count == 50);
}

TEST_CASE("an edit of everything leaves nothing as it was") {
  SmoothOptions start;
  start.formulation = Formulation::pointwise;
  start.linear.restart = 7;
  start.threads = 3;
  whole(SmoothOptions()).apply_to(start);
  CHECK(start.formulation == SmoothOptions().formulation);
  CHECK(start.linear == LinearOptions());
  CHECK(start.threads == 0);
}

TEST_CASE("options of the solver and of motions are edited field by field, too") {
  SmoothOptions smooth;
  SmoothOptions damped = smooth, long_run = smooth;
  damped.damping = 0.1;
  long_run.max_iterations = 9;
  difference(SmoothOptions(), damped).apply_to(smooth);
  difference(SmoothOptions(), long_run).apply_to(smooth);
  CHECK(smooth.damping == 0.1);
  CHECK(smooth.max_iterations == 9);
  MotionOptions motion;
  difference(MotionOptions(), MotionOptions{8, true}).apply_to(motion);
  difference(MotionOptions(), MotionOptions{0, false}).apply_to(motion);
  CHECK(motion.increments == 8);
  CHECK_FALSE(motion.smooth_after);
}

TEST_CASE("the size of a picture is that of the window times a scale, or as typed") {
  CHECK(picture_size({}, 640, 480) == std::array{640, 480});
  CHECK(picture_size({.scale = 3, .size = {}}, 640, 480) == std::array{1920, 1440});
  CHECK(picture_size({.size = std::array{1000, 100}}, 640, 480) == std::array{1000, 100});
}

TEST_CASE("a picture too small or too large to draw is refused") {
  CHECK_THROWS_AS(picture_size({.size = std::array{8, 100}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{40000, 100}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{30000, 30000}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.scale = 1e12, .size = {}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{-5, 100}}, 640, 480), UsageError);
}

TEST_CASE("The interface has the scale that was chosen, or else the screen's") {
  InterfaceScale scale(1.5f);
  scale.set_window(3000, 2000);
  CHECK(scale.of(0) == 1.5f);
  CHECK(scale.of(1.25) == 1.25f);
  scale.set_screen(2);
  CHECK(scale.of(0) == 2.0f);
}

TEST_CASE("A small window has the largest scale of the list that it has room for") {
  InterfaceScale scale(1);
  scale.set_window(1100, 720);  // room for 1.53 in width, 1.6 in height
  CHECK(scale.fitting(1.5) == 1.5f);
  CHECK(scale.fitting(3) == 1.5f);
  scale.set_window(1100, 560);
  CHECK(scale.fitting(3) == 1.1f);
  scale.set_window(100, 100);  // never less than the smallest
  CHECK(scale.fitting(3) == 0.75f);
}

}  // namespace winslow::gui::test
