#include <doctest/doctest.h>

#include <fstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui::test {

namespace {

bool said(const Rig& rig, const char* what) {
  const auto& notice = rig.session().messages().notice();
  return notice && notice->text.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("the dark theme darkens panels, menus and what lies behind the mesh") {
  Rig rig;
  rig.open(ring_mesh());
  // A place beside the mesh, one in a panel, one in the toolbar.
  const ScreenPoint beside = rig.pixel(Vec2(3.3, 0));
  const ScreenPoint panel(20, 700 - 40);
  const Image light = rig.bench->pictures().picture();
  rig.key(GLFW_KEY_D, {keys::control});
  const Image dark = rig.bench->pictures().picture();
  for (const ScreenPoint& p : {beside, panel, ScreenPoint(700, 40)}) {
    CHECK(brightness(light, p) > 0.9);
    CHECK(brightness(dark, p) < 0.25);
  }
  rig.key(GLFW_KEY_D, {keys::control});
  CHECK(rig.bench->pictures().picture().rgba == light.rgba);
}

TEST_CASE("the background can be grey, black or a gradient whatever the theme") {
  Rig rig;
  rig.open(ring_mesh());
  const Area v = rig.bench->layout().viewport;
  const ScreenPoint top(v.x + 10, v.y + 10);
  const ScreenPoint bottom(v.x + 10, v.y + v.height - 10);
  set_view(rig, [](ViewOptions& view) { view.backdrop = Backdrop::black; });
  CHECK(brightness(rig.bench->pictures().picture(), top) == 0);
  set_view(rig, [](ViewOptions& view) { view.backdrop = Backdrop::grey; });
  CHECK(brightness(rig.bench->pictures().picture(), top) == doctest::Approx(0.81).epsilon(0.03));
  set_view(rig, [](ViewOptions& view) { view.backdrop = Backdrop::gradient; });
  const Image gradient = rig.bench->pictures().picture();
  CHECK(brightness(gradient, top) > brightness(gradient, bottom) + 0.1);
}

TEST_CASE("edges are light where the background is dark") {
  ViewOptions view;
  view.color.reset();
  const MeshColors light = mesh_colors(view);
  view.lightness = Lightness::dark;
  const MeshColors dark = mesh_colors(view);
  CHECK(light.edge[0] + 0.3f < light.fill[0]);
  CHECK(dark.edge[0] > dark.fill[0] + 0.3f);
  view.backdrop = Backdrop::white;
  CHECK_FALSE(mesh_colors(view).dark);
}

TEST_CASE("the scale of the interface is chosen, or the screen's own") {
  Rig rig(1500, 960);
  rig.open(ring_mesh());
  const auto height = [&] {
    const auto r = rig.bench->widgets().find("solver/step_n");
    REQUIRE(r.has_value());
    return r->max.y() - r->min.y();
  };
  const double before = height();
  for (int i = 0; i < 3; ++i) rig.key(GLFW_KEY_EQUAL, {keys::control});
  CHECK(rig.bench->view_control().options().scale == 1.5);
  CHECK(height() == doctest::Approx(1.5 * before).epsilon(0.1));
  rig.key(GLFW_KEY_MINUS, {keys::control});
  CHECK(rig.bench->view_control().options().scale == 1.25);
  rig.key(GLFW_KEY_0, {keys::control});
  CHECK(height() == before);
  CHECK_FALSE(said(rig, "no room"));
  for (int i = 0; i < 6; ++i) rig.key(GLFW_KEY_EQUAL, {keys::control});
  CHECK(rig.bench->view_control().options().scale == 2);
  CHECK(said(rig, "no room for a larger interface"));
  set_view(rig, [](ViewOptions& view) { view.scale = 3; });
  CHECK(said(rig, "room for 200 % only"));
  rig.key(GLFW_KEY_MINUS, {keys::control});
  CHECK(rig.bench->view_control().options().scale == 1.75);
  for (int i = 0; i < 8; ++i) rig.key(GLFW_KEY_MINUS, {keys::control});
  CHECK(rig.bench->view_control().options().scale == .75);
  CHECK(said(rig, "as small as it gets"));
  rig.key(GLFW_KEY_0, {keys::control});
  // Moved to a screen that wants two pixels for one.
  rig.bench->set_scale(2);
  rig.frames();
  CHECK(height() == doctest::Approx(2 * before).epsilon(0.1));
  // More than the window has room for.
  rig.bench->set_scale(3);
  rig.frames();
  CHECK(height() == doctest::Approx(2 * before).epsilon(0.1));
  rig.resize(800, 500);
  rig.frames();
  CHECK(height() == doctest::Approx(1.1 * before).epsilon(0.1));
}

TEST_CASE("W steps through surfaces and edges, surfaces, edges") {
  Rig rig;
  rig.open(two_body_mesh());
  const ScreenPoint middle = rig.pixel(Vec2(0.25, 0.3));
  const ScreenPoint edge = rig.pixel(Vec2(0.0, 0.25));
  const auto picture = [&] { return rig.bench->pictures().picture(); };
  Image both = picture();
  CHECK(brightness(both, edge) < brightness(both, middle) - 0.1);
  rig.key(keys::w);
  CHECK(rig.bench->view_control().options().fill);
  const Image surfaces = picture();
  CHECK(brightness(surfaces, edge) == doctest::Approx(brightness(surfaces, middle)).epsilon(0.02));
  rig.key(keys::w);
  const Image edges = picture();
  CHECK(brightness(edges, middle) == 1);
  CHECK(brightness(edges, edge) < 0.8);
  rig.key(keys::w);
  CHECK(picture().rgba == both.rgba);
}

TEST_CASE("the picture kept of a large mesh is the one that would be drawn, whatever changes") {
  Rig rig;
  const Mesh mesh = ring_mesh(240, 60);
  REQUIRE(mesh.topology->node_count() > 12000);
  rig.open(mesh);
  Image last;
  const auto check_kept = [&](const char* what, bool changes) {
    CAPTURE(what);
    const Image kept = rig.bench->pictures().picture();
    rig.bench->pane().mesh_view().forget_picture();
    CHECK((kept.rgba == rig.bench->pictures().picture().rgba));
    CHECK((kept.rgba != last.rgba) == changes);
    last = kept;
  };
  check_kept("opened", true);
  check_kept("nothing", false);
  set_view(rig, [](ViewOptions& view) { view.color_map = "plasma"; });
  check_kept("another map", true);
  rig.wheel(rig.pixel(Vec2(1.5, 0.3)), 2);
  check_kept("zoom", true);
  rig.move(rig.pixel(Vec2(0.5, 0)));
  rig.frames();
  REQUIRE_FALSE(rig.session().selection().hovered().empty());
  check_kept("a body under the mouse", true);
  set_view(rig, [](ViewOptions& view) { view.nodes = true; });
  check_kept("nodes", true);
  set_view(rig, [](ViewOptions& view) { view.comparison = Comparison::split; });
  check_kept("comparison", true);
  rig.bench->apply(action::Scramble{});
  REQUIRE(rig.settle());
  check_kept("another mesh", true);
  rig.resize(900, 600);
  rig.frames();
  check_kept("another size", true);
}

namespace {

/// Labels that do not fit into their button, list or panel, in the columns as they are.
void check_labels(Rig& rig) {
  for (const auto& widget : rig.bench->widgets().all()) {
    INFO("widget ", widget.first);
    CHECK_FALSE(widget.second.cut);
  }
}

void check_tabs(Rig& rig) {
  check_labels(rig);
  for (const SideTab tab : {SideTab::quality, SideTab::view, SideTab::vcv, SideTab::history}) {
    INFO("tab ", static_cast<int>(tab));
    set_view(rig, [&](ViewOptions& view) {
      view.right_panel = true;
      view.side_tab = tab;
    });
    check_labels(rig);
  }
  // Where there is no room for both columns the left one takes the place of the right.
  set_view(rig, [](ViewOptions& view) {
    view.left_panel = true;
    view.right_panel = false;
  });
  REQUIRE(rig.visible("layers/insert"));
  check_labels(rig);
}

}  // namespace

TEST_CASE("no button, list or switch cuts its label, at any size and scale") {
  struct Screen {
    int width, height;
    float scale;
  };
  Rig rig(1280, 1800);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  REQUIRE(rig.settle());
  // All that is folded at first, from below so that nothing moves before it is clicked.
  for (const char* part :
       {"section/mesh", "solver/advanced", "section/layers", "section/shape", "motion/limits"}) {
    INFO(part);
    if (!rig.visible(part)) continue;
    rig.click(part);
    REQUIRE(rig.settle());
  }
  REQUIRE(rig.visible("layers/insert"));
  REQUIRE(rig.visible("shape/fade"));
  REQUIRE(rig.visible("solver/defaults"));
  REQUIRE(rig.visible("motion/min_quality_skewness/on"));
  for (const Screen& s : {Screen{760, 480, 1}, Screen{1024, 768, 1}, Screen{1200, 750, 1},
                          Screen{1280, 720, 1}, Screen{1440, 900, 1}, Screen{1440, 900, 1.5f},
                          Screen{1024, 768, 1.5f}, Screen{1920, 1080, 2}, Screen{2560, 1440, 2}}) {
    INFO(s.width, " x ", s.height, " at ", s.scale);
    rig.resize(s.width, s.height);
    rig.bench->set_scale(s.scale);
    rig.frames(4);
    REQUIRE(rig.settle());
    check_tabs(rig);
  }
}

TEST_CASE("Ctrl+Z in a field that is entered again takes nothing back from another text") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  // Shown with six digits when the field is left: shorter than what was typed.
  rig.click("motion/dx");
  rig.key(keys::a, {keys::control});
  rig.type("0.12345678901234");
  rig.key(keys::tab);
  rig.click("motion/dx");
  for (int i = 0; i < 12; ++i) rig.key(keys::z, {keys::control});
  rig.key(GLFW_KEY_END);
  rig.type("5");
  rig.key(keys::tab);
  rig.click("motion/apply");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion motion =
      std::get<MoveCommand>(rig.document().history().command(1)).motion.about({0, 0});
  CHECK(motion.translate.x() == doctest::Approx(0.1234575).epsilon(1e-12));
  CHECK(motion.translate.y() == 0);
}

TEST_CASE("Ctrl+Z after a name was taken from the list keeps the dialog whole") {
  Rig rig;
  write(rig.folder, ring_mesh(), "a.su2");
  rig.key(keys::o, {keys::control});
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.type(rig.folder.path().string() + "/");
  REQUIRE(rig.wait([&] {
    return !rig.bench->dialogs().file_dialog().busy() &&
           rig.bench->dialogs().file_dialog().folder() == rig.folder.path();
  }));
  rig.key(keys::z, {keys::control});  // the path was taken out of the field
  rig.type("a name longer than that of the file");
  rig.key(GLFW_KEY_DOWN);
  for (int i = 0; i < 3; ++i) rig.key(keys::z, {keys::control});
  rig.key(GLFW_KEY_DOWN);
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().name() == "a.su2");
}

}  // namespace winslow::gui::test
