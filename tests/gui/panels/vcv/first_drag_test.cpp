#include <doctest/doctest.h>

#include "gui/support/vcv_rig.h"

namespace winslow::gui::test {

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
