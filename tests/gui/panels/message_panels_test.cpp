#include <doctest/doctest.h>

#include "core/quality/quality.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("the banner of inverted elements leads to the worst of them") {
  Rig rig;
  rig.open(tangled_mesh());
  REQUIRE(rig.session().messages().banner().has_value());
  REQUIRE(rig.settle());
  rig.frames();
  rig.click("banner/zoom_to_worst");
  const Index worst = worst_element(rig.mesh(), Metric::normalized_jacobian);
  CHECK(rig.bench->view_control().state().focus == MeshItem{MeshItem::Kind::element, worst});
  const ScreenPoint at = rig.pixel(element_centre(rig.mesh(), worst).head<2>());
  const Area& v = rig.bench->layout().viewport;
  CHECK(at.x() > v.x);
  CHECK(at.x() < v.x + v.width);
  CHECK(at.y() > v.y);
  CHECK(at.y() < v.y + v.height);
  // The banner stays: nothing has been done about what it says.
  CHECK(rig.visible("banner/zoom_to_worst"));
}

TEST_CASE("a motion that was blocked offers the worst element") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(40, 0)}});
  REQUIRE(rig.settle());
  REQUIRE(rig.visible("banner/undo"));
  rig.click("banner/zoom_to_worst");
  CHECK(rig.bench->view_control().state().focus ==
        MeshItem{MeshItem::Kind::element, worst_element(rig.mesh(), Metric::normalized_jacobian)});
}

TEST_CASE("in a narrow view the buttons of a banner wrap, none beyond its strip") {
  Rig rig(760, 480);
  rig.open(tangled_mesh());
  for (const int width : {1440, 1024, 760}) {
    INFO("width ", width);
    rig.resize(width, 480);
    rig.frames(4);
    REQUIRE(rig.settle());
    const Area& v = rig.bench->layout().viewport;
    for (const char* id : {"banner/smooth", "banner/zoom_to_worst", "banner/keep"}) {
      INFO(id);
      const auto button = rig.bench->widgets().find(id);
      REQUIRE(button.has_value());
      CHECK(button->shown);
      CHECK(button->min.x() >= v.x);
      CHECK(button->max.x() <= v.x + v.width);
    }
  }
}

}  // namespace winslow::gui::test
