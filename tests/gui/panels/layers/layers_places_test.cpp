#include <doctest/doctest.h>

#include <map>

#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("buttons stay in their places while a plan is made, arrives, and is carried out") {
  Rig rig(1280, 1500);
  rig.open(ring_mesh(240, 40));  // a plan takes longer than a frame
  rig.click("marker/flap");
  rig.frames(3);
  rig.click("section/layers");
  REQUIRE(rig.settle());
  REQUIRE(rig.visible("layers/insert"));
  const auto places = [&] {
    std::map<std::string, double> tops;
    for (const char* id :
         {"layers/count", "layers/control", "layers/preview", "layers/insert", "layers/corners"}) {
      INFO(id);
      const auto rect = rig.bench->widgets().find(id);
      REQUIRE(rect.has_value());
      tops[id] = rect->min.y();
    }
    return tops;
  };
  const auto there = places();
  REQUIRE(rig.session().jobs().layer_preview().plan() != nullptr);
  // Other settings: for some frames there is no plan, unless it is made within a frame.
  int without = 0;
  for (const char* first :
       {"0.013", "0.014", "0.015", "0.016", "0.017", "0.018", "0.019", "0.011"}) {
    rig.fill("layers/first", first);
    do {
      without += rig.session().jobs().layer_preview().plan() == nullptr;
      CHECK(places() == there);
      rig.frames(1);
    } while (rig.session().jobs().layer_preview().busy());
    if (without > 0) break;
  }
  CHECK(without > 0);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().jobs().layer_preview().plan() != nullptr);
  CHECK(places() == there);
}

}  // namespace winslow::gui::test
