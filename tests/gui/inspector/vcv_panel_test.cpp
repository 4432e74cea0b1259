#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/inspect/nodal_view.h"
#include "gui/studio/keys.h"
#include "gui/studio/pixels.h"
#include "gui/studio/rig.h"

namespace winslow::gui::test {

namespace {

/// A free node in the middle of the ring with six neighbours, none of them on the boundary.
Index inner_node(const Rig& rig, std::size_t skip = 0) {
  const Topology& topology = *rig.mesh().topology;
  for (const Index node : topology.free_nodes()) {
    const auto ring = topology.neighbours(node);
    const bool inner = ring.size() == 6 &&
                       std::ranges::none_of(ring, [&](Index k) { return topology.constrained(k); });
    if (inner && skip-- == 0) return node;
  }
  FAIL("no such node");
  return -1;
}

NodalView view_of(const Rig& rig, Index node) {
  return inspect_node(*rig.session().vcv(), rig.session().coordinates(), node);
}

void open_ring(Rig& rig) {
  rig.open(ring_mesh());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.click("tab/vcv");
}

bool valid(const Rig& rig) {
  return check_validity(*rig.mesh().topology, rig.session().coordinates()).inverted == 0;
}

Vec2 end_of_edge(const Rig& rig, std::size_t k) {
  const auto rect = rig.bench->widgets().find("vcv/end/" + std::to_string(k));
  REQUIRE(rect.has_value());
  return rect->centre();
}

void enter_node(Rig& rig, const std::string& number) {
  rig.click("vcv/node");
  rig.key(keys::a, {keys::control});
  rig.type(number);
  rig.key(keys::enter);
}

/// Drags an end of the VCV across the picture and lets go.
void drag_end(Rig& rig, std::size_t k, const Vec2& by) {
  const Vec2 from = end_of_edge(rig, k);
  rig.drag(from, from + by, 5);
}

}  // namespace

TEST_CASE("with the VCV tab open a click near a node inspects it and leaves the selection alone") {
  Rig rig(1300, 800);
  open_ring(rig);
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  CHECK(rig.visible("vcv/hint"));
  const Index node = inner_node(rig);
  const Vec2 at = rig.pixel(rig.mesh().coordinates.xy(node));
  rig.move(at + Vec2(3, -2));
  rig.frames(1);
  CHECK(rig.session().nodes().hovered() == node);
  rig.click(at + Vec2(3, -2));
  CHECK(rig.session().nodes().inspected() == node);
  CHECK(rig.session().selected(rig.marker("flap")));
  CHECK(rig.visible("vcv/plot"));
  CHECK(rig.visible("vcv/row/5"));
  CHECK_FALSE(rig.visible("vcv/row/6"));
}

TEST_CASE("Alt and a click inspect a node from any tab; without Alt it does not") {
  Rig rig(1300, 800);
  rig.open(ring_mesh());
  const Vec2 at = rig.pixel(rig.mesh().coordinates.xy(inner_node(rig)));
  rig.click(at);
  CHECK_FALSE(rig.session().nodes().inspected().has_value());
  rig.input.key(keys::alt, true);
  rig.click(at);
  rig.input.key(keys::alt, false);
  rig.frames();
  CHECK(rig.session().nodes().inspected() == inner_node(rig));
  CHECK(rig.bench->view().side_tab == SideTab::vcv);
}

TEST_CASE("a typed number inspects a node; one on the boundary has no VCV, and the panel says so") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig, 3);
  enter_node(rig, std::to_string(node));
  CHECK(rig.session().nodes().inspected() == node);
  CHECK(rig.visible("vcv/kappa"));
  const Index rim = rig.mesh().topology->marker_nodes(rig.marker("flap"))[0];
  enter_node(rig, std::to_string(rim));
  CHECK(rig.session().nodes().inspected() == rim);
  CHECK(rig.visible("vcv/none"));
  CHECK_FALSE(rig.visible("vcv/plot"));
  enter_node(rig, "99999");
  CHECK(rig.session().nodes().inspected() == rim);
  REQUIRE(rig.session().notice().has_value());
  CHECK(rig.session().notice()->text.find("no node 99999") != std::string::npos);
}

TEST_CASE("a body is still dragged by its rim while the VCV tab is open") {
  Rig rig(1300, 800);
  open_ring(rig);
  const std::size_t steps = rig.document().history().size();
  const Index rim = rig.mesh().topology->marker_nodes(rig.marker("flap"))[3];
  const Vec2 from = rig.pixel(rig.mesh().coordinates.xy(rim));
  rig.drag(from, from + Vec2(30, 10));
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
  const Vec2 centre = rig.bench->widgets().find("vcv/plot")->centre();
  const Vec2 end = end_of_edge(rig, 2);
  // Across the edge, counter-clockwise on screen: y is down.
  const Vec2 out = end - centre;
  drag_end(rig, 2, 0.5 * Vec2(out.y(), -out.x()));
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
    drag_end(rig, 1, Vec2(-16, 9));
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
  drag_end(rig, 0, Vec2(-20, -20));
  REQUIRE(rig.session().job().active());
  rig.key(keys::escape);
  CHECK_FALSE(rig.session().job().active());
  rig.move(end_of_edge(rig, 0) + Vec2(5, 5));
  CHECK_FALSE(rig.session().job().active());
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.session().coordinates() == before);
  CHECK(rig.document().history().size() == steps);
}

TEST_CASE("typed angle, Apply to pinned nodes, Reset and Reset all") {
  Rig rig(1300, 1000);
  open_ring(rig);
  const Index node = inner_node(rig), second = inner_node(rig, 4), third = inner_node(rig, 9);
  rig.bench->apply(action::InspectNode{node});
  rig.bench->apply(action::PinNodes{{node, second, third}});
  rig.frames(3);
  rig.click("vcv/row/2");
  rig.fill("vcv/angle", "85");
  REQUIRE(rig.settle());
  CHECK(degrees(rig.session().vcv()->angles(node)[2]) == doctest::Approx(85));
  CHECK(degrees(rig.session().vcv()->angles(node)[0]) == doctest::Approx(55));
  rig.frames(3);
  rig.click("vcv/apply");
  REQUIRE(rig.settle());
  CHECK(rig.session().vcv()->edits().size() == 3);
  // The wide angle lies the same way in the mesh, whatever the neighbours' numbers.
  const auto direction = [&](Index of) {
    const NodalView view = view_of(rig, of);
    const auto widest = std::ranges::max_element(view.vcv.angles) - view.vcv.angles.begin();
    const auto k = static_cast<std::size_t>(widest);
    return (view.physical.points[k] / view.physical.lengths[k] +
            view.physical.points[(k + 1) % 6] / view.physical.lengths[(k + 1) % 6])
        .normalized()
        .eval();
  };
  CHECK(direction(node).dot(direction(second)) > 0.5);
  CHECK(valid(rig));
  rig.frames(3);
  rig.click("vcv/reset");
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.session().vcv()->edited(node));
  CHECK(rig.session().vcv()->edits().size() == 2);
  rig.frames(3);
  rig.click("vcv/reset_all");
  REQUIRE(rig.settle());
  CHECK(rig.session().vcv()->edits().empty());
  CHECK(describe(rig.document().history().command(rig.document().history().position())) ==
        "Reset the VCVs of 2 nodes");
}

TEST_CASE(
    "Apply within a radius changes the nodes there that have as many neighbours, and no other") {
  Rig rig(1300, 1000);
  open_ring(rig);
  const Index node = inner_node(rig);
  enter_node(rig, std::to_string(node));
  rig.fill("vcv/length", "2.5");
  REQUIRE(rig.settle());
  rig.frames(3);
  const std::size_t steps = rig.document().history().size();
  const double radius = 2.2 * view_of(rig, node).physical.mean_length();
  std::vector<Index> expected, others;
  for (const Index k : rig.mesh().topology->free_nodes()) {
    const double away =
        (rig.session().coordinates().xy(k) - rig.session().coordinates().xy(node)).norm();
    const bool inside = away <= radius && rig.mesh().topology->neighbours(k).size() == 6;
    (inside ? expected : others).push_back(k);
  }
  REQUIRE(expected.size() > 4);
  REQUIRE(others.size() > expected.size());
  rig.click("vcv/spread");
  rig.frames(3);
  rig.click("vcv/spread/Nodes within a radius");
  rig.frames(3);
  rig.fill("vcv/radius", std::to_string(radius));
  CHECK(rig.document().history().size() == steps);
  rig.click("vcv/apply");
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == steps + 1);
  for (const Index k : expected) {
    INFO("node ", k);
    CHECK(rig.session().vcv()->edited(k));
    CHECK(std::ranges::max(view_of(rig, k).vcv.lengths) == doctest::Approx(2.5));
  }
  for (const Index k : others) CHECK_FALSE(rig.session().vcv()->edited(k));
  CHECK(valid(rig));
  rig.key(keys::z, {keys::control});
  CHECK(rig.session().vcv()->edits().size() == 1);
}

TEST_CASE("a radius with no other node in it changes nothing") {
  Rig rig(1300, 1000);
  open_ring(rig);
  enter_node(rig, std::to_string(inner_node(rig)));
  rig.click("vcv/spread");
  rig.frames(3);
  rig.click("vcv/spread/Nodes within a radius");
  rig.frames(3);
  const std::size_t steps = rig.document().history().size();
  for (const char* radius : {"1e-9", "-1"}) {
    rig.fill("vcv/radius", radius);
    rig.frames(3);
    rig.click("vcv/apply");
    REQUIRE(rig.settle());
    CHECK(rig.document().history().size() == steps);
    CHECK(rig.session().vcv()->edits().empty());
  }
}

TEST_CASE("typed angles and lengths: taken by Enter and Tab, the rest shared, nonsense refused") {
  Rig rig(1300, 1000);
  open_ring(rig);
  const Index node = inner_node(rig);
  enter_node(rig, std::to_string(node));
  const auto angles = [&] { return view_of(rig, node).vcv.angles; };
  const auto lengths = [&] { return view_of(rig, node).vcv.lengths; };
  rig.click("vcv/row/1");
  rig.fill("vcv/angle", "90");
  REQUIRE(rig.settle());
  CHECK(degrees(angles()[1]) == doctest::Approx(90));
  rig.frames(3);
  rig.click("vcv/row/4");
  rig.click("vcv/angle");
  rig.key(keys::a, {keys::control});
  rig.type("40");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  // Of the 320 degrees left each has the share that it had of 306.
  CHECK(degrees(angles()[4]) == doctest::Approx(40));
  CHECK(degrees(angles()[1]) == doctest::Approx(90.0 * 320 / 306));
  CHECK(degrees(angles()[0]) == doctest::Approx(54.0 * 320 / 306));
  rig.frames(3);
  rig.fill("vcv/length", "1.75");
  REQUIRE(rig.settle());
  CHECK(lengths()[4] == doctest::Approx(1.75));
  CHECK(lengths()[3] == doctest::Approx(1));
  CHECK(degrees(angles()[4]) == doctest::Approx(40));
  CHECK(valid(rig));
  CHECK(rig.document().history().size() == 1 + 3 + 1);  // as loaded, smoothed, and three edits
  const auto [angles_before, lengths_before] = std::pair{angles(), lengths()};
  const std::size_t steps = rig.document().history().size();
  for (const char* text : {"0", "-30", "180", "400", "nan"}) {
    rig.frames(3);
    rig.fill("vcv/angle", text);
    REQUIRE(rig.settle());
  }
  for (const char* text : {"0", "-2", "inf"}) {
    rig.frames(3);
    rig.fill("vcv/length", text);
    REQUIRE(rig.settle());
  }
  // Esc gives the field back what it had.
  rig.click("vcv/angle");
  rig.key(keys::a, {keys::control});
  rig.type("77");
  rig.key(keys::escape);
  rig.frames(3);
  CHECK(angles() == angles_before);
  CHECK(lengths() == lengths_before);
  CHECK(rig.document().history().size() == steps);
  CHECK(rig.session().prompt() == nullptr);
}

TEST_CASE("a pinned VCV is drawn over the mesh, and gone when it is unpinned") {
  Rig rig(1300, 800);
  open_ring(rig);
  const Index node = inner_node(rig);
  rig.bench->apply(action::InspectNode{node});
  rig.move(Vec2(5, 795));
  rig.frames(3);
  const Image plain = rig.bench->picture();
  const Vec2 at = rig.pixel(rig.mesh().coordinates.xy(node));
  const double reach =
      0.7 * view_of(rig, node).physical.mean_length() / rig.bench->camera().units_per_pixel();
  const Vec2 box = Vec2::Constant(reach);
  rig.click("vcv/pin");
  rig.move(Vec2(5, 795));
  rig.frames(2);
  CHECK(rig.session().nodes().pinned() == std::vector<Index>{node});
  const int changed = differing(plain, rig.bench->picture(), at - box, at + box);
  CHECK(changed > 2 * reach * reach);
  rig.click("vcv/clear_pins");
  rig.move(Vec2(5, 795));
  rig.frames(2);
  CHECK(rig.session().nodes().pinned().empty());
  CHECK(differing(plain, rig.bench->picture(), at - box, at + box) == 0);
}

TEST_CASE("colouring by kappa changes the mesh and its legend, and follows an edit") {
  Rig rig(1300, 800);
  open_ring(rig);
  ViewOptions view = rig.bench->view();
  const Image plain = rig.bench->picture();
  view.color = NodalField::kappa;
  rig.bench->apply(action::SetView{view});
  REQUIRE(rig.settle());
  rig.frames(2);
  const Area& v = rig.bench->layout().viewport;
  const Vec2 min(v.x, v.y), max(v.x + v.width, v.y + v.height);
  CHECK(differing(plain, rig.bench->picture(), min, max) > 10000);
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
  REQUIRE(rig.session().prompt() != nullptr);
  CHECK(rig.session().prompt()->text.find(std::to_string(node)) != std::string::npos);
  CHECK_FALSE(rig.session().job().active());
  rig.bench->apply(action::DismissPrompt{});
  rig.bench->apply(action::OpenMesh{write(rig.folder, two_body_mesh(), "other.su2"), true});
  REQUIRE(rig.settle());
  CHECK(rig.session().nodes().pinned().empty());
}

}  // namespace winslow::gui::test
