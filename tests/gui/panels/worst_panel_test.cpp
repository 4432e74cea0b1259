#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "gui/view/navigation/worst_list.h"

namespace winslow::gui::test {

TEST_CASE("the list of worst elements stands still under the mouse") {
  Rig rig(1440, 1400);
  rig.open(ring_mesh());
  const auto worst = [&] {
    return worst_elements(rig.session(), rig.bench->view_control().options())[1].element;
  };
  const Index before = worst();
  const auto row = rig.bench->widgets().find("quality/worst/1");
  REQUIRE(row.has_value());
  rig.move(row->centre());
  rig.frames();
  rig.bench->apply(action::Scramble{1});
  REQUIRE(rig.settle());
  rig.frames();
  REQUIRE(worst() != before);
  rig.press();
  rig.release();
  REQUIRE(rig.bench->view_control().state().focus.has_value());
  CHECK(rig.bench->view_control().state().focus->id == before);
  // Elsewhere it follows the mesh again.
  rig.move(rig.pixel(Vec2(2, 2)));
  rig.frames(4);
  rig.move(row->centre());
  rig.frames();
  rig.press();
  rig.release();
  CHECK(rig.bench->view_control().state().focus->id == worst());
}

}  // namespace winslow::gui::test
