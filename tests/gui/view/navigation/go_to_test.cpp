#include "gui/view/navigation/go_to.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

Vec2 middle_of(const Mesh& mesh, Index element) {
  Vec2 sum(0, 0);
  for (const Index node : mesh.topology->element(element)) sum += mesh.coordinates.xy(node);
  return sum / static_cast<double>(mesh.topology->element(element).size());
}

std::string value(const Rig& rig, const MeshItem& item, const std::string& name) {
  for (const auto& [key, text] : describe_item(item, rig.session()))
    if (key == name) return text;
  return "no " + name;
}

}  // namespace

TEST_CASE("Ctrl+G and what is typed at once after it, with the column on the right folded") {
  for (const int width : {1280, 760}) {
    CAPTURE(width);
    Rig rig(width, 700);
    rig.open(ring_mesh());
    set_view(rig, [](ViewOptions& view) {
      view.side_tab = SideTab::view;
      view.right_panel = false;
      view.left_panel = true;
    });
    REQUIRE_FALSE(rig.visible("go_to/field"));
    // As fast as it can be typed: the queue knows no pause.
    rig.input.key(keys::control, true);
    for (const bool down : {true, false}) rig.input.key(GLFW_KEY_G, down);
    rig.input.key(keys::control, false);
    for (const char c : {'e', '4', '5'}) rig.input.text(static_cast<char32_t>(c));
    for (const bool down : {true, false}) rig.input.key(keys::enter, down);
    rig.frames(4);
    CHECK(rig.bench->view_control().state().focus == MeshItem{MeshItem::Kind::element, 45});
    CHECK(rig.visible("go_to/field"));
  }
}

TEST_CASE("Ctrl+G and an id go to an element, highlight it and say what it is") {
  Rig rig(1280, 1700);
  rig.open(ring_mesh());
  set_view(rig, [](ViewOptions& view) { view.side_tab = SideTab::view; });
  rig.key(GLFW_KEY_G, {keys::control});
  rig.frames(2);
  REQUIRE(rig.visible("go_to/field"));
  rig.type("e45");
  rig.key(keys::enter);
  const MeshItem item{MeshItem::Kind::element, 45};
  REQUIRE(rig.bench->view_control().state().focus == item);
  const Vec2 middle = middle_of(rig.mesh(), 45);
  CHECK((rig.bench->view_control().camera().centre() - middle).norm() <
        0.1 * rig.bench->view_control().camera().visible().size().norm());
  rig.frames();
  CHECK(rig.visible("go_to/item"));
  CHECK(value(rig, item, "Element 45") == "triangle");
  CHECK(value(rig, item, "Normalized Jacobian").substr(0, 4) ==
        std::to_string(element_value(rig.mesh(), 45, Metric::normalized_jacobian)).substr(0, 4));
  // Asked for again, it takes another place instead of adding to the last.
  rig.key(GLFW_KEY_G, {keys::control});
  rig.frames(2);
  rig.type("e46");
  rig.key(keys::enter);
  CHECK(rig.bench->view_control().state().focus == MeshItem{MeshItem::Kind::element, 46});
  rig.key(GLFW_KEY_G, {keys::control});
  rig.frames(2);
  rig.type("e45");
  rig.key(keys::enter);
  rig.frames();
  const Image lit = rig.bench->pictures().picture();
  rig.click("go_to/clear");
  rig.frames();
  const Area v = rig.bench->layout().viewport;
  CHECK(differing(lit, rig.bench->pictures().picture(), ScreenPoint(v.x, v.y),
                  ScreenPoint(v.x + v.width, v.y + v.height)) > 100);
}

TEST_CASE("a node is found by its id, by a point and by its marker") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  const MeshItem node = parse_item("n7", rig.session(), rig.bench->view_control().options());
  CHECK(node == MeshItem{MeshItem::Kind::node, 7});
  CHECK(value(rig, node, "Degree") == std::to_string(rig.mesh().topology->neighbours(7).size()));
  CHECK(value(rig, node, "Marker") == "flap");
  const Vec2 p = rig.mesh().coordinates.xy(60);
  const std::string point = std::to_string(p.x()) + ", " + std::to_string(p.y());
  CHECK(parse_item(point, rig.session(), rig.bench->view_control().options()).id == 60);
  const MeshItem far = parse_item("farfield", rig.session(), rig.bench->view_control().options());
  CHECK(value(rig, far, "Marker") == "farfield");
  CHECK(parse_item(" #12 ", rig.session(), rig.bench->view_control().options()) ==
        MeshItem{MeshItem::Kind::element, 12});
}

TEST_CASE("what cannot be gone to is said, and nothing moves") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  for (const char* text : {"n99999", "e-1", "", "  ", "node 5", "1, 2, 3", "nan, 0", "worst 0",
                           "worst 5000", "n", "n1.5"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_item(text, rig.session(), rig.bench->view_control().options()),
                    UsageError);
  }
  const Vec2 before = rig.bench->view_control().camera().centre();
  rig.key(GLFW_KEY_G, {keys::control});
  rig.frames(2);
  rig.type("e99999");
  rig.key(keys::enter);
  CHECK(rig.visible("go_to/error"));
  CHECK_FALSE(rig.bench->view_control().state().focus.has_value());
  CHECK(rig.bench->view_control().camera().centre() == before);
}

TEST_CASE("the list of worst elements: metric, length, click, next and previous") {
  Rig rig(1280, 1700);
  rig.open(ring_mesh());
  CHECK(worst_elements(rig.session(), rig.bench->view_control().options()).size() == 20);
  rig.click("worst/metric");
  rig.click("worst/metric/" + std::string(metric_label(Metric::condition_number)));
  rig.click("worst/count");
  rig.click("worst/count/10");
  const auto worst = worst_elements(rig.session(), rig.bench->view_control().options());
  REQUIRE(worst.size() == 10);
  const auto& report = rig.session().quality().latest()->report;
  for (std::size_t k = 0; k < 10; ++k)
    CHECK(worst[k].element == report.of(Metric::condition_number).worst[k].element);
  rig.click("quality/worst/1");
  CHECK(rig.bench->view_control().state().focus ==
        MeshItem{MeshItem::Kind::element, worst[1].element});
  CHECK((rig.bench->view_control().camera().centre() - worst[1].centre.head<2>()).norm() <
        0.1 * rig.bench->view_control().camera().visible().size().norm());
  rig.move(rig.pixel(worst[1].centre.head<2>()));
  rig.type("]");
  CHECK(rig.bench->view_control().state().focus->id == worst[2].element);
  rig.type("[");
  rig.type("[");
  rig.type("[");
  CHECK(rig.bench->view_control().state().focus->id == worst[0].element);
  CHECK(parse_item("worst 3", rig.session(), rig.bench->view_control().options()).id ==
        worst[2].element);
}

TEST_CASE("another mesh forgets what was gone to") {
  Rig rig;
  rig.open(two_body_mesh());
  rig.bench->apply(action::GoTo{MeshItem{MeshItem::Kind::node, 3}});
  REQUIRE(rig.bench->view_control().state().focus.has_value());
  rig.bench->apply(action::GoTo{MeshItem{MeshItem::Kind::node, 100000}});
  CHECK(rig.bench->view_control().state().focus->id == 3);
  rig.open(ring_mesh(), "other.su2");
  CHECK_FALSE(rig.bench->view_control().state().focus.has_value());
  CHECK_FALSE(rig.bench->view_control().state().can_go_back);
}

}  // namespace winslow::gui::test
