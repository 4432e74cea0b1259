#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

Index flap_node(const Rig& rig, std::size_t k) {
  return rig.mesh().topology->markers().nodes(rig.marker("flap"))[k];
}

double moved(const Rig& rig, const Mesh& before, Index node) {
  return (rig.mesh().coordinates.xy(node) - before.coordinates.xy(node)).norm();
}

/// The highest node of the flap: no corner is near it.
Index top_node(const Rig& rig) {
  Index top = flap_node(rig, 0);
  for (Index node : rig.mesh().topology->markers().nodes(rig.marker("flap")))
    if (rig.mesh().coordinates.xy(node).y() > rig.mesh().coordinates.xy(top).y()) top = node;
  return top;
}

const DeformCommand& last_deform(const Rig& rig) {
  const History& history = rig.document().history();
  return std::get<DeformCommand>(history.command(history.position()));
}

}  // namespace

TEST_CASE("a boundary node is dragged alone when nothing fades") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::e);
  REQUIRE(rig.session().selection().shape_edit().active);
  rig.bench->apply(action::SetShapeEdit{true, 0});
  const Mesh before = rig.mesh();
  const Index top = top_node(rig);
  const ScreenPoint from = rig.pixel(before.coordinates.xy(top));
  rig.drag(from, from + ScreenVector(0, -12));
  CHECK(rig.session().dragging());
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const double by = 12 * rig.bench->view_control().camera().units_per_pixel();
  const Vec2 wanted = before.coordinates.xy(top) + Vec2(0, by);
  CHECK((rig.mesh().coordinates.xy(top) - wanted).norm() < 1e-9);
  for (Index node : before.topology->markers().nodes(rig.marker("flap")))
    if (node != top) CHECK(moved(rig, before, node) == 0);
  CHECK(check_validity(*before.topology, rig.mesh().coordinates).inverted == 0);
  CHECK(last_deform(rig).markers == std::vector<std::string>{"flap"});
  rig.key(keys::z, {keys::control});
  CHECK(rig.mesh().coordinates == before.coordinates);
}

TEST_CASE("the wheel widens what a drag takes along, while it is under way") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::e);
  rig.bench->apply(action::SetShapeEdit{true, 0});
  const Mesh before = rig.mesh();
  const Index top = top_node(rig);
  const ScreenPoint from = rig.pixel(before.coordinates.xy(top));
  rig.drag(from, from + ScreenVector(0, -10));
  const double zoom = rig.bench->view_control().camera().units_per_pixel();
  for (int k = 0; k < 8; ++k) {
    rig.input.wheel(Vec2(0, 1));
    rig.frames(1);
  }
  CHECK(rig.bench->view_control().camera().units_per_pixel() == zoom);
  const double radius = rig.session().selection().shape_edit().radius;
  CHECK(radius > 0.2);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  int along = 0;
  const double whole = moved(rig, before, top);
  CHECK(whole == doctest::Approx(10 * zoom));
  for (Index node : before.topology->markers().nodes(rig.marker("flap"))) {
    const double d = moved(rig, before, node);
    CHECK(d <= whole * (1 + 1e-12));
    along += d > 0 && node != top;
  }
  CHECK(along >= 2);
  CHECK(along < 23);
}

TEST_CASE("Shift+click takes the arc between two nodes, and a drag moves it whole") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::e);
  rig.bench->apply(action::SetShapeEdit{true, 0});
  const Mesh before = rig.mesh();
  const BoundaryIndex& boundary = *rig.session().mesh().boundary();
  const Index body = [&] {
    for (std::size_t b = 0; b < boundary.bodies().size(); ++b)
      if (boundary.bodies()[b].hole) return static_cast<Index>(b);
    return Index(-1);
  }();
  REQUIRE(body >= 0);
  const auto& loop = boundary.bodies()[static_cast<std::size_t>(body)].nodes;
  const auto at = [&](std::size_t k) { return rig.pixel(before.coordinates.xy(loop[k])); };
  rig.click(at(4));
  CHECK(rig.session().selection().shape_edit().arc == BoundaryArc{body, 4, 4});
  rig.input.key(keys::shift, true);
  rig.click(at(7));
  rig.input.key(keys::shift, false);
  CHECK(rig.session().selection().shape_edit().arc == BoundaryArc{body, 4, 7});
  const Vec2 outward = before.coordinates.xy(loop[5]).normalized();
  rig.drag(at(6), at(6) + 8 * ScreenVector(outward.x(), -outward.y()));
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    CAPTURE(k);
    const double d = moved(rig, before, loop[k]);
    if (k >= 4 && k <= 7)
      CHECK(d == doctest::Approx(8 * rig.bench->view_control().camera().units_per_pixel()));
    else
      CHECK(d == 0);
  }
}

TEST_CASE("editing shapes never drags a body, and Esc ends it") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  rig.key(keys::e);
  // Near enough that the middle of the body is away from its nodes.
  rig.wheel(rig.pixel(Vec2(0, 0)), 6);
  const ScreenPoint inside = rig.pixel(Vec2(0, 0));
  const Vec2 world = rig.bench->view_control().camera().to_world(inside);
  rig.drag(inside, inside + ScreenVector(20, 20));
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 1);
  CHECK((rig.bench->view_control().camera().to_screen(world) - (inside + ScreenVector(20, 20)))
            .norm() < 1e-6);
  rig.key(keys::escape);
  CHECK_FALSE(rig.session().selection().shape_edit().active);
  CHECK_FALSE(rig.session().selection().empty());
}

TEST_CASE("the sine panel shows its outline first and then deforms by it") {
  Rig rig(1280, 1200);
  rig.open(ring_mesh());
  rig.click("section/shape");
  rig.click("marker/flap");
  const Mesh before = rig.mesh();
  rig.move(ScreenPoint(2, 2));
  rig.frames();
  const Image plain = rig.bench->pictures().picture();
  rig.fill("shape/amplitude", "0.05");
  rig.fill("shape/waves", "2");
  rig.frames();
  REQUIRE(rig.session().selection().deformation_preview().has_value());
  CHECK(rig.session().selection().deformation_preview()->outline.size() == 24);
  rig.move(ScreenPoint(2, 2));
  rig.frames();
  const ScreenPoint low = rig.pixel(Vec2(-0.6, 0.25));
  const ScreenPoint high = rig.pixel(Vec2(0.6, -0.25));
  CHECK(differing(plain, rig.bench->pictures().picture(), low, high) > 20);
  CHECK(rig.mesh().coordinates == before.coordinates);
  rig.click("shape/apply");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK_FALSE(rig.session().selection().deformation_preview().has_value());
  for (Index node : before.topology->markers().nodes(rig.marker("flap"))) {
    const Vec2 was = before.coordinates.xy(node);
    const double s = was.x() + 0.5;
    const Vec2 wanted = was + Vec2(0, 0.05 * std::sin(2 * pi * 2 * s));
    CHECK((rig.mesh().coordinates.xy(node) - wanted).norm() < 1e-9);
  }
  CHECK(rig.document().history().result(1).inverted == 0);
}

TEST_CASE("files of single nodes are chosen below the sine, with nothing selected") {
  Rig rig(1280, 1200);
  rig.open(ring_mesh());
  rig.click("section/shape");
  const Coordinates before = rig.mesh().coordinates;
  const Index node = rig.mesh().topology->interior_nodes().front();
  std::ofstream(rig.folder / "ways.csv") << "node,dx,dy\n" << node << ",0.003,0.002\n";
  for (const char* button : {"shape/positions", "shape/displacements"}) {
    rig.click(button);
    REQUIRE(rig.wait([&] {
      const FileDialog& dialog = rig.bench->dialogs().file_dialog();
      return dialog.is_open() && !dialog.busy();
    }));
    rig.type("ways.csv");
    rig.key(keys::enter);
    REQUIRE(rig.settle());
    rig.frames();
    if (!rig.session().messages().prompt()) break;
    // They are no positions.
    CHECK(std::string(button) == "shape/positions");
    rig.key(keys::enter);
    rig.frames();
  }
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.mesh().coordinates.xy(node) == Vec2(before.xy(node) + Vec2(0.003, 0.002)));
  CHECK(rig.document().history().result(1).inverted == 0);
}

TEST_CASE("half-typed sines show nothing and do no harm") {
  Rig rig(1280, 1200);
  rig.open(ring_mesh());
  rig.click("section/shape");
  rig.click("marker/flap");
  rig.fill("shape/amplitude", "0.05");
  CHECK(rig.session().selection().deformation_preview().has_value());
  rig.fill("shape/amplitude", "0");
  rig.frames();
  CHECK_FALSE(rig.session().selection().deformation_preview().has_value());
  CHECK_FALSE(rig.bench->widgets().find("shape/apply")->enabled);
  CHECK(rig.document().history().size() == 1);
}

TEST_CASE("editing nodes is a mode that is seen: it is named, and its nodes are drawn") {
  Rig rig;
  rig.open(ring_mesh());
  CHECK_FALSE(rig.visible("mode"));
  CHECK_FALSE(rig.visible("shape/nodes/48"));
  rig.key(keys::e);
  CHECK(rig.visible("mode"));
  CHECK(rig.visible("shape/nodes/48"));  // all of them: they are few
  const ScreenPoint node = rig.pixel(rig.mesh().coordinates.xy(flap_node(rig, 3)));
  const Image drawn = rig.bench->pictures().picture();
  rig.key(keys::e);
  CHECK_FALSE(rig.visible("mode"));
  const Image plain = rig.bench->pictures().picture();
  CHECK(differing(drawn, plain, node - ScreenVector(4, 4), node + ScreenVector(4, 4)) > 4);
}

TEST_CASE("of many boundary nodes those near the mouse are drawn") {
  Rig rig;
  rig.open(ring_mesh(500, 4));
  rig.key(keys::e);
  rig.move(rig.pixel(Vec2(2.9, 0)));
  rig.frames();
  int drawn = 0;
  for (const auto& [name, rect] : rig.bench->widgets().all())
    if (name.starts_with("shape/nodes/")) drawn = std::stoi(name.substr(12));
  CHECK(drawn > 0);
  CHECK(drawn < 400);
}

TEST_CASE("a click beside a node says what to do") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::e);
  rig.click(rig.pixel(Vec2(1.4, 0.9)));
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->text.starts_with("No boundary node is there."));
  // With an arc in hand it lets go of that, and has nothing to say.
  rig.key(keys::e);
  rig.key(keys::e);
  rig.click(rig.pixel(rig.mesh().coordinates.xy(top_node(rig))));
  REQUIRE(rig.session().selection().shape_edit().arc.has_value());
  rig.click(rig.pixel(Vec2(1.4, 0.9)));
  CHECK_FALSE(rig.session().selection().shape_edit().arc.has_value());
}

}  // namespace winslow::gui::test
