#include <doctest/doctest.h>

#include <algorithm>

#include "gui/support/vcv_rig.h"

namespace winslow::gui::test {

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
  for (const Index k : rig.mesh().topology->interior_nodes()) {
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

TEST_CASE("the button says to how many nodes a VCV goes, and is off where there is none") {
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
    CHECK_FALSE(rig.bench->widgets().find("vcv/apply")->enabled);
    rig.click("vcv/apply");
    REQUIRE(rig.settle());
    CHECK(rig.document().history().size() == steps);
    CHECK(rig.session().vcv()->edits().empty());
  }
  rig.fill("vcv/radius", "1e9");
  rig.frames(3);
  CHECK(rig.bench->widgets().find("vcv/apply")->enabled);
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
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE(
    "an edge length beyond all arithmetic is refused with a reason; a very long one is drawn") {
  Rig rig(1300, 1000);
  open_ring(rig);
  const Index node = inner_node(rig);
  enter_node(rig, std::to_string(node));
  const std::size_t steps = rig.document().history().size();
  rig.fill("vcv/length", "1e99");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt());
  CHECK(rig.session().messages().prompt()->text.find("1e12 times") != std::string::npos);
  CHECK(rig.document().history().size() == steps);
  rig.key(keys::enter);
  rig.frames(3);
  REQUIRE_FALSE(rig.session().messages().prompt());

  rig.fill("vcv/length", "5000");
  REQUIRE(rig.settle());
  CHECK(view_of(rig, node).vcv.lengths[0] == 5000);
  rig.frames(3);
  const auto plot = rig.bench->widgets().find("vcv/plot");
  const auto end = rig.bench->widgets().find("vcv/end/0");
  const auto other = rig.bench->widgets().find("vcv/end/3");
  REQUIRE(plot);
  REQUIRE(end);
  REQUIRE(other);
  // The long edge fills the picture; the others end where it begins.
  const double size = (plot->max - plot->min).x();
  CHECK((end->centre() - plot->centre()).norm() == doctest::Approx(0.38 * size).epsilon(0.01));
  CHECK((other->centre() - plot->centre()).norm() < 1);
}

TEST_CASE("what the mouse holds stays held when the first run makes other panels appear") {
  Rig rig(1300, 800);
  rig.open(ring_mesh());
  rig.click("tab/vcv");
  rig.bench->apply(action::InspectNode{inner_node(rig)});
  rig.frames(3);
  const std::size_t steps = rig.document().history().size();
  const ScreenPoint from = rig.bench->widgets().find("vcv/end/2")->centre();
  rig.drag(from, from + ScreenVector(-12, 9), 6);
  CHECK(rig.session().job().active());
  CHECK(rig.session().mesh().held().vcv);
  CHECK(rig.document().history().size() == steps);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == steps + 1);
}

}  // namespace winslow::gui::test
