#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "gui/view/navigation/worst_list.h"

namespace winslow::gui::test {

TEST_CASE("the list of worst elements stands still under the mouse") {
  Rig rig(1440, 1400);
  rig.open(ring_mesh());
  rig.click("section/walls");  // its rows come and go above the list
  rig.frames();
  const auto worst = [&](std::size_t k) {
    return worst_elements(rig.session(), rig.bench->view_control().options())[k].element;
  };
  const auto rest_on = [&](const std::string& row) {
    rig.frames(3);
    const auto rect = rig.bench->widgets().find(row);
    REQUIRE(rect.has_value());
    rig.move(rect->centre());
    rig.frames();
    return rect->min;
  };
  const auto click = [&] {
    rig.press();
    rig.release();
    REQUIRE(rig.bench->view_control().state().focus.has_value());
    return rig.bench->view_control().state().focus->id;
  };
  // With the mouse elsewhere it follows the mesh.
  const Index as_opened = worst(1);
  rig.bench->apply(action::Scramble{2});
  REQUIRE(rig.settle());
  REQUIRE(worst(1) != as_opened);
  rest_on("quality/worst/1");
  CHECK(click() == worst(1));
  // Under the mouse it does not, until the click has ended.
  const ScreenPoint at = rest_on("quality/worst/2");
  const Index before = worst(2);
  rig.bench->apply(action::Scramble{1});
  REQUIRE(rig.settle());
  rig.frames();
  REQUIRE(worst(2) != before);
  REQUIRE(rig.bench->widgets().find("quality/worst/2")->min == at);
  CHECK(click() == before);
}

}  // namespace winslow::gui::test
