#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "gui/support/pixels.h"
#include "gui/support/vcv_rig.h"

namespace winslow::gui::test {

namespace {

ScreenPoint end_of_edge(const Rig& rig, std::size_t k) {
  const auto rect = rig.bench->widgets().find("vcv/end/" + std::to_string(k));
  REQUIRE(rect.has_value());
  return rect->centre();
}

/// Drags an end of the VCV across the picture and lets go.
void drag_end(Rig& rig, std::size_t k, const ScreenVector& by) {
  const ScreenPoint from = end_of_edge(rig, k);
  rig.drag(from, from + by, 5);
}

}  // namespace

TEST_CASE("with the VCV tab open a click near a node inspects it and leaves the selection alone") {
  Rig rig(1300, 800);
  open_ring(rig);
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  CHECK(rig.visible("vcv/hint"));
  const Index node = inner_node(rig);
  const ScreenPoint at = rig.pixel(rig.mesh().coordinates.xy(node));
  rig.move(at + ScreenVector(3, -2));
  rig.frames(1);
  CHECK(rig.session().nodes().hovered() == node);
  rig.click(at + ScreenVector(3, -2));
  CHECK(rig.session().nodes().inspected() == node);
  CHECK(rig.session().selection().contains(rig.marker("flap")));
  CHECK(rig.visible("vcv/plot"));
  CHECK(rig.visible("vcv/row/5"));
  CHECK_FALSE(rig.visible("vcv/row/6"));
}

TEST_CASE("Alt and a click inspect a node from any tab; without Alt it does not") {
  Rig rig(1300, 800);
  rig.open(ring_mesh());
  const ScreenPoint at = rig.pixel(rig.mesh().coordinates.xy(inner_node(rig)));
  rig.click(at);
  CHECK_FALSE(rig.session().nodes().inspected().has_value());
  rig.input.key(keys::alt, true);
  rig.click(at);
  rig.input.key(keys::alt, false);
  rig.frames();
  CHECK(rig.session().nodes().inspected() == inner_node(rig));
  CHECK(rig.bench->view_control().options().side_tab == SideTab::vcv);
}

TEST_CASE("a typed number inspects a node; one on the boundary has no VCV, and the panel says so") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig, 3);
  enter_node(rig, std::to_string(node));
  CHECK(rig.session().nodes().inspected() == node);
  CHECK(rig.visible("vcv/kappa"));
  const Index rim = rig.mesh().topology->markers().nodes(rig.marker("flap"))[0];
  enter_node(rig, std::to_string(rim));
  CHECK(rig.session().nodes().inspected() == rim);
  CHECK(rig.visible("vcv/none"));
  CHECK_FALSE(rig.visible("vcv/plot"));
  const Camera before = rig.bench->view_control().camera();
  enter_node(rig, "99999");
  CHECK(rig.bench->view_control().camera().centre() == before.centre());
  // One out of sight is brought into it; one in sight leaves the view alone.
  rig.bench->apply(action::LookAt{Vec3(50, 50, 0), 1});
  rig.frames();
  enter_node(rig, std::to_string(node));
  rig.frames();
  const ScreenPoint seen = rig.pixel(rig.mesh().coordinates.xy(node));
  const Area& v = rig.bench->layout().viewport;
  CHECK((seen - ScreenPoint(v.x + v.width / 2, v.y + v.height / 2)).norm() < 100);
  const Vec2 centre = rig.bench->view_control().camera().centre();
  enter_node(rig, std::to_string(rig.mesh().topology->neighbours(node)[0]));
  CHECK(rig.bench->view_control().camera().centre() == centre);
  enter_node(rig, std::to_string(rim));
  enter_node(rig, "99999");
  CHECK(rig.session().nodes().inspected() == rim);
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->text.find("no node 99999") != std::string::npos);
}

TEST_CASE("a body is still dragged by its rim while the VCV tab is open") {
  Rig rig(1300, 800);
  open_ring(rig);
  const std::size_t steps = rig.document().history().size();
  const Index rim = rig.mesh().topology->markers().nodes(rig.marker("flap"))[3];
  const ScreenPoint from = rig.pixel(rig.mesh().coordinates.xy(rim));
  rig.drag(from, from + ScreenVector(30, 10));
  CHECK(rig.session().dragging());
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == steps + 1);
  CHECK_FALSE(rig.session().nodes().inspected().has_value());
}

TEST_CASE("dragging an end of a VCV opens the angle of the mesh while held; one step of history") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::InspectNode{node});
  rig.frames(3);
  const Mesh before = rig.mesh();
  const std::size_t steps = rig.document().history().size();
  const NodalView start = view_of(rig, node);
  const ScreenPoint centre = rig.bench->widgets().find("vcv/plot")->centre();
  const ScreenPoint end = end_of_edge(rig, 2);
  // Across the edge, counter-clockwise on screen: y is down.
  const ScreenVector out = end - centre;
  drag_end(rig, 2, 0.5 * ScreenVector(out.y(), -out.x()));
  REQUIRE(rig.session().job().active());
  const bool followed = rig.wait([&] {
    return valid(rig) && view_of(rig, node).physical.angles[1] > start.physical.angles[1] + 0.05;
  });
  CHECK(followed);
  CHECK(rig.document().history().size() == steps);
  CHECK(rig.session().vcv()->edited(node));
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == steps + 1);
  CHECK(valid(rig));
  const auto& command = std::get<EditVcvCommand>(rig.document().history().command(steps));
  REQUIRE(command.edits.size() == 1);
  CHECK(command.edits[0].node == node);
  CHECK(command.edits[0].angles[1] > 70);
  CHECK(command.edits[0].angles[1] + command.edits[0].angles[2] == doctest::Approx(120));
  CHECK(rig.document().history().result(steps).converged);
  rig.bench->apply(action::Undo{});
  CHECK(rig.mesh().coordinates == before.coordinates);
  CHECK_FALSE(rig.session().vcv()->edited(node));
}

TEST_CASE("Shift keeps the length of an edge, Ctrl its angles") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::InspectNode{node});
  rig.frames(3);
  for (const int modifier : {keys::shift, keys::control}) {
    const std::size_t steps = rig.document().history().position();
    rig.input.key(modifier, true);
    drag_end(rig, 1, ScreenVector(-16, 9));
    rig.release();
    rig.input.key(modifier, false);
    REQUIRE(rig.settle());
    REQUIRE(rig.document().history().position() == steps + 1);
    const VcvEdit edit =
        std::get<EditVcvCommand>(rig.document().history().command(steps + 1)).edits[0];
    const bool turned = std::abs(edit.angles[0] - 60) > 1;
    const bool pulled = std::abs(edit.lengths[1] - 1) > 0.01;
    CHECK(turned == (modifier == keys::shift));
    CHECK(pulled == (modifier == keys::control));
    rig.bench->apply(action::Undo{});
    rig.frames(3);
  }
}

TEST_CASE("Esc ends a drag of a VCV and puts the mesh back") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::InspectNode{node});
  rig.frames(3);
  const Coordinates before = rig.session().coordinates();
  const std::size_t steps = rig.document().history().size();
  drag_end(rig, 0, ScreenVector(-20, -20));
  REQUIRE(rig.session().job().active());
  rig.key(keys::escape);
  CHECK_FALSE(rig.session().job().active());
  rig.move(end_of_edge(rig, 0) + ScreenVector(5, 5));
  CHECK_FALSE(rig.session().job().active());
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.session().coordinates() == before);
  CHECK(rig.document().history().size() == steps);
}

TEST_CASE("a pinned VCV is drawn over the mesh, and gone when it is unpinned") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::InspectNode{node});
  rig.move(ScreenPoint(5, 795));
  rig.frames(3);
  const Image plain = rig.bench->pictures().picture();
  const ScreenPoint at = rig.pixel(rig.mesh().coordinates.xy(node));
  const double reach = 0.7 * view_of(rig, node).physical.mean_length() /
                       rig.bench->view_control().camera().units_per_pixel();
  const ScreenVector box(reach, reach);
  rig.click("vcv/pin");
  rig.move(ScreenPoint(5, 795));
  rig.frames(2);
  CHECK(rig.session().nodes().pinned() == std::vector<Index>{node});
  const int changed = differing(plain, rig.bench->pictures().picture(), at - box, at + box);
  CHECK(changed > 2 * reach * reach);
  rig.click("vcv/clear_pins");
  rig.move(ScreenPoint(5, 795));
  rig.frames(2);
  CHECK(rig.session().nodes().pinned().empty());
  CHECK(differing(plain, rig.bench->pictures().picture(), at - box, at + box) == 0);
}

TEST_CASE("colouring by kappa changes the mesh and its legend, and follows an edit") {
  Rig rig(1300, 800);
  open_ring(rig);
  ViewOptions view = rig.bench->view_control().options();
  const Image plain = rig.bench->pictures().picture();
  view.color = NodalField::kappa;
  rig.bench->apply(action::EditView{whole(view)});
  REQUIRE(rig.settle());
  rig.frames(2);
  const Area& v = rig.bench->layout().viewport;
  const ScreenPoint min(v.x, v.y), max(v.x + v.width, v.y + v.height);
  CHECK(differing(plain, rig.bench->pictures().picture(), min, max) > 10000);
  const auto& measured = rig.session().quality().latest();
  REQUIRE(measured != nullptr);
  CHECK(measured->field == NodalField::kappa);
  const auto direct =
      element_values(*rig.session().vcv(), rig.session().coordinates(), NodalField::kappa, 1);
  CHECK(measured->values.size() == direct.size());
  const Index node = inner_node(rig);
  const auto around = static_cast<std::size_t>(rig.mesh().topology->star(node)[0]);
  CHECK(measured->values[around] == direct[around]);
  rig.bench->apply(action::EditVcvs{{{node, {}, {}, {3, 1, 1, 1, 1, 1}}}});
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(rig.session().quality().latest()->values[around] != direct[around]);
}

TEST_CASE("another edit is refused while one is under way; a mesh that is opened has no pins") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::PinNodes{{node, 0, -3, 100000}});
  CHECK(rig.session().nodes().pinned() == std::vector<Index>{node});
  rig.bench->apply(action::EditVcvs{{{node, {}, {}, {2, 1, 1, 1, 1, 1}}}, true});
  rig.bench->apply(action::EndVcvEdit{});
  REQUIRE(rig.settle());
  rig.bench->apply(action::EditVcvs{{{node, {}, {10, 350, 0, 0, 0, 0}, {}}}});
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->text.find(std::to_string(node)) != std::string::npos);
  CHECK_FALSE(rig.session().job().active());
  rig.bench->apply(action::DismissPrompt{});
  rig.bench->apply(action::OpenMesh{write(rig.folder, two_body_mesh(), "other.su2"), true});
  REQUIRE(rig.settle());
  CHECK(rig.session().nodes().pinned().empty());
}

}  // namespace winslow::gui::test
