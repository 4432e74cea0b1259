#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "gui/support/pixels.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

MarkerLook look(const Rig& rig, const std::string& marker) {
  return rig.bench->view_control().options().markers.of(marker);
}

}  // namespace

TEST_CASE("a marker may have a name of any length") {
  Rig rig;
  const TemporaryFolder meshes;
  const std::filesystem::path path = write(meshes, two_body_mesh(), "one.su2");
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  std::string mesh = text.str();
  const std::string name(70000, 'W');
  mesh.replace(mesh.find("left"), 4, name);
  std::ofstream(path) << mesh;
  rig.bench->apply(action::OpenMesh{path, true});
  REQUIRE(rig.settle());
  const ScreenPoint row = rig.bench->widgets().find("marker/" + name)->centre();
  rig.move(row);
  rig.frames(60);  // until its tooltip is shown
  rig.click("marker/" + name);
  CHECK(rig.session().selection().contains(rig.marker(name)));
  rig.frames(5);
}

TEST_CASE("a hidden marker is not drawn, and the mouse passes through it") {
  Rig rig;
  rig.open(two_body_mesh());
  set_view(rig, [](ViewOptions& view) { view.color.reset(); });
  const Image before = rig.bench->pictures().picture();
  rig.click("marker_hide/left");
  CHECK(look(rig, "left").hidden);
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  const Image after = rig.bench->pictures().picture();
  const ScreenPoint corner = rig.pixel(Vec2(-2.5, 0.2));  // on the left side of the hole
  const auto x = static_cast<int>(corner.x());
  const auto y = static_cast<int>(corner.y());
  bool changed = false;
  for (int dx = -3; dx <= 3; ++dx)
    changed |=
        !std::equal(before.pixel(x + dx, y), before.pixel(x + dx, y) + 3, after.pixel(x + dx, y));
  CHECK(changed);
  rig.click(rig.pixel(Vec2(-2, 0)));
  CHECK(rig.session().selection().empty());
  rig.click("marker_hide/left");
  CHECK_FALSE(look(rig, "left").hidden);
  rig.click(rig.pixel(Vec2(-2, 0)));
  CHECK(rig.session().selection().contains(rig.marker("left")));
}

TEST_CASE("a locked marker is neither dragged nor selected") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click("marker/left");
  REQUIRE(rig.session().selection().contains(rig.marker("left")));
  rig.click("marker_lock/left");
  CHECK(look(rig, "left").locked);
  CHECK(rig.session().selection().empty());  // a lock takes it out of the selection
  rig.click("marker/left");
  CHECK(rig.session().selection().empty());
  const ScreenPoint at = rig.pixel(Vec2(-2, 0));
  rig.click(at);
  CHECK(rig.session().selection().empty());
  rig.drag(at, at + ScreenVector(30, 0));
  CHECK_FALSE(rig.session().dragging());
  rig.release();
  rig.key(keys::a, {keys::control});  // all bodies
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  rig.key(keys::escape);
  rig.key(keys::tab);
  rig.key(keys::tab);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  rig.click("marker_lock/left");
  rig.click(rig.pixel(Vec2(-2, 0)));
  CHECK(rig.session().selection().contains(rig.marker("left")));
}

TEST_CASE("a marker gets another colour, and its own back") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click("marker_color/left");
  rig.frames(2);
  REQUIRE(rig.visible("marker_color/choice/Orange"));
  rig.click("marker_color/choice/Orange");
  REQUIRE(look(rig, "left").color.has_value());
  CHECK((*look(rig, "left").color)[0] > 0.8f);
  const VectorFigure figure = rig.bench->pictures().figure(false);
  const Rgb drawn = figure.marker_colors[static_cast<std::size_t>(rig.marker("left"))].value();
  CHECK(drawn == *look(rig, "left").color);
  rig.click("marker_color/left");
  rig.frames(2);
  rig.click("marker_color/automatic");
  CHECK_FALSE(look(rig, "left").color.has_value());
}

TEST_CASE("a marker gets a colour that is none of those offered, which is kept with the mesh") {
  TemporaryFolder profile, meshes;
  const auto mesh = write(meshes, two_body_mesh(), "one.su2");
  std::optional<Rgb> chosen;
  {
    Rig rig(1280, 720, profile.path());
    rig.bench->apply(action::OpenMesh{mesh, true});
    REQUIRE(rig.settle());
    rig.click("marker_color/left");
    rig.frames(2);
    rig.click("marker_color/other");
    rig.frames(3);
    REQUIRE(rig.visible("marker_color/picker"));
    CHECK_FALSE(rig.visible("marker_color/other"));  // one popup after the other
    const auto picker = rig.bench->widgets().find("marker_color/picker");
    // Two places of its square of colours.
    const ScreenVector size = picker->max - picker->min;
    rig.click(picker->min + ScreenVector(0.2 * size.x(), 0.2 * size.x()));
    const auto first = look(rig, "left").color;
    REQUIRE(first.has_value());
    rig.click(picker->min + ScreenVector(0.6 * size.x(), 0.4 * size.x()));
    chosen = look(rig, "left").color;
    REQUIRE(chosen.has_value());
    CHECK(*chosen != *first);
    CHECK(rig.visible("marker_color/picker"));  // it stays until it is done
    const VectorFigure figure = rig.bench->pictures().figure(false);
    CHECK(figure.marker_colors[static_cast<std::size_t>(rig.marker("left"))] == chosen);
    rig.click("marker_color/done");
    rig.frames(2);
    CHECK_FALSE(rig.visible("marker_color/picker"));
    CHECK(look(rig, "left").color == chosen);
  }
  Rig rig(1280, 720, profile.path());
  rig.settle();
  while (rig.session().messages().prompt()) rig.key(keys::escape);
  rig.bench->apply(action::OpenMesh{mesh, true});
  REQUIRE(rig.settle());
  REQUIRE(look(rig, "left").color.has_value());
  for (std::size_t c = 0; c < 3; ++c)
    CHECK((*look(rig, "left").color)[c] == doctest::Approx((*chosen)[c]).epsilon(1e-5));
}

TEST_CASE("what is hidden, locked and coloured is remembered of the mesh, not of another") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  const auto one = write(meshes, two_body_mesh(), "one.su2");
  const auto other = write(meshes, two_body_mesh(), "other.su2");
  const auto open = [](Rig& rig, const std::filesystem::path& path) {
    rig.bench->apply(action::OpenMesh{path, true});
    REQUIRE(rig.settle());
  };
  {
    Rig rig(1280, 720, profile.path());
    open(rig, one);
    rig.click("marker_hide/left");
    rig.click("marker_lock/right");
  }
  Rig rig(1280, 720, profile.path());
  rig.settle();
  while (rig.session().messages().prompt()) rig.key(keys::escape);
  open(rig, one);
  CHECK(look(rig, "left").hidden);
  CHECK(look(rig, "right").locked);
  open(rig, other);
  CHECK_FALSE(look(rig, "left").hidden);
  CHECK_FALSE(look(rig, "right").locked);
}

TEST_CASE("fields of vectors say which is x and which is y") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.click("marker/left");
  const auto x = rig.bench->widgets().find("motion/dx");
  const auto y = rig.bench->widgets().find("motion/dy");
  REQUIRE(x.has_value());
  REQUIRE(y.has_value());
  CHECK(rig.visible("motion/dx/label"));
  CHECK(rig.visible("motion/dy/label"));
  CHECK(rig.bench->widgets().find("motion/dy/label")->max.x() <= y->min.x());
  CHECK(y->max.x() - y->min.x() > 50);  // room for numbers
}

TEST_CASE("a click on a marker's role has it slide: a body that turns takes the far field along") {
  Rig rig;
  rig.open(ring_mesh());
  const Coordinates before = rig.mesh().coordinates;
  rig.click("marker_role/farfield");
  CHECK(rig.session().solver_settings().smooth_options().slide.markers ==
        std::vector<std::string>{"farfield"});
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{20, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.settle());
  for (const Index node : rig.document().topology()->markers().nodes(rig.marker("farfield"))) {
    const Vec2 from = before.xy(node), to = rig.mesh().coordinates.xy(node);
    CHECK(to.norm() == doctest::Approx(from.norm()).epsilon(1e-9));
    CHECK((to - from).norm() > 0.01);
  }
  // What is selected moves; its role is no button then.
  rig.click("marker_role/flap");
  CHECK(rig.session().solver_settings().smooth_options().slide.markers.size() == 1);
  rig.click("marker_role/farfield");
  CHECK(rig.session().solver_settings().smooth_options().slide.markers.empty());
}

TEST_CASE("a marker that slides and is then moved does not slide; another mesh knows no roles") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker_role/flap");
  rig.click("marker_role/farfield");
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.settle());
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().position() == 1);
  const Command& done = rig.document().history().command(1);
  CHECK(std::get<MoveCommand>(done).smooth.slide.markers == std::vector<std::string>{"farfield"});
  rig.bench->apply(action::OpenMesh{write(rig.folder, two_body_mesh(), "other.su2"), true});
  REQUIRE(rig.settle());
  CHECK(rig.session().solver_settings().smooth_options().slide.markers.empty());
}

}  // namespace winslow::gui::test
