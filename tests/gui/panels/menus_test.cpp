#include <doctest/doctest.h>
#include <imgui.h>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

void right_click(Rig& rig, const ScreenPoint& at) {
  rig.move(at);
  rig.frames(1);
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(2);
}

}  // namespace

TEST_CASE("a right click on a body offers to move, rotate and layer it") {
  Rig rig(1280, 900);
  rig.open(two_body_mesh());
  right_click(rig, rig.pixel(Vec2(-2, 0)));
  REQUIRE(rig.visible("menu_title/left"));
  for (const char* entry : {"menu/body/select", "menu/body/move", "menu/body/rotate",
                            "menu/body/layers", "menu/body/hold_layers", "menu/body/hide"})
    CHECK(rig.visible(entry));
  rig.click("menu/body/rotate");
  rig.frames(4);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("left")});
  rig.type("12");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).motion.rotate == 12);
}

TEST_CASE("a right click on a node and an element offers what is known of them") {
  Rig rig;
  rig.open(two_body_mesh());
  Index node = -1;  // an interior one
  for (Index i = 0; i < rig.mesh().topology->node_count() && node < 0; ++i)
    if (!rig.mesh().topology->on_boundary(i)) node = i;
  REQUIRE(node >= 0);
  const Vec2 at = rig.mesh().coordinates.xy(node);
  right_click(rig, rig.pixel(at));
  REQUIRE(rig.visible("menu_title/Node " + std::to_string(node)));
  rig.click("menu/node/copy_place");
  const Vec2 parsed = [] {
    Vec2 p(0, 0);
    std::sscanf(ImGui::GetClipboardText(), "%lf, %lf", &p.x(), &p.y());
    return p;
  }();
  CHECK((parsed - at).norm() < 1e-8);
  right_click(rig, rig.pixel(at));
  rig.click("menu/node/inspect");
  CHECK(rig.session().nodes().inspected() == node);
  CHECK(rig.bench->view_control().options().side_tab == SideTab::vcv);
  right_click(rig, rig.pixel(at + Vec2(0.2, 0.22)));
  CHECK(rig.visible("menu/element/isolate"));
  rig.click("menu/element/isolate");
  CHECK(rig.bench->view_control().options().isolation.on);
}

TEST_CASE("the right button still pans when it is dragged, and Esc closes its menu") {
  Rig rig;
  rig.open(two_body_mesh());
  const ScreenPoint from = rig.pixel(Vec2(0, 1.5));
  const Vec2 centre = rig.bench->view_control().camera().centre();
  rig.drag(from, from + ScreenVector(60, 0), 6, MouseButton::right);
  rig.release(MouseButton::right);
  CHECK_FALSE(rig.visible("menu/fit"));
  CHECK(rig.bench->view_control().camera().centre() != centre);
  right_click(rig, from);
  REQUIRE(rig.visible("menu/fit"));
  rig.bench->apply(action::SelectMarkers{{rig.marker("left")}});
  rig.key(keys::escape);
  CHECK_FALSE(rig.visible("menu/fit"));
  CHECK(rig.session().selection().markers().size() == 1);  // Esc did nothing else
}

TEST_CASE("the menu of a node closes when a mesh comes that may not have it") {
  Rig rig;
  rig.open(ring_mesh());
  const Index last = rig.mesh().topology->node_count() - 1;
  rig.bench->apply(action::ShowContextMenu{{rig.mesh().coordinates.xy(last), {}, last, {}}});
  rig.frames(2);
  REQUIRE(rig.visible("menu/node/inspect"));
  rig.open(two_body_mesh());
  REQUIRE(rig.mesh().topology->node_count() <= last);
  rig.frames(2);
  CHECK_FALSE(rig.visible("menu/node/inspect"));
}

TEST_CASE("a right click in the list of markers offers the same") {
  Rig rig;
  rig.open(two_body_mesh());
  right_click(rig, rig.bench->widgets().find("marker/right")->centre());
  CHECK(rig.visible("menu_title/right"));
  rig.click("menu/body/lock");
  CHECK(rig.bench->view_control().options().markers.of("right").locked);
}

}  // namespace winslow::gui::test
