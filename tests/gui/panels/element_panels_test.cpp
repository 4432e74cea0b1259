#include <doctest/doctest.h>

#include "gui/support/rig.h"
#include "gui/view/navigation/go_to.h"

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

namespace {

/// The first of the list by a field, with what the mesh was before.
Index first_by(const Mesh& mesh, WallField field, const Coordinates& before) {
  const auto values = element_values(mesh, field, &before);
  const auto worst = winslow::worst_elements(mesh, values, wall_field_info(field), 1);
  return worst.empty() ? -1 : worst.front().element;
}

}  // namespace

TEST_CASE("elements are ranked by what is measured at walls, as chosen or as coloured") {
  Rig rig(1440, 1400);
  rig.open(ring_mesh());
  const Coordinates loaded = rig.mesh().coordinates;
  turn_flap(rig, 30);
  const Coordinates between = rig.mesh().coordinates;
  turn_flap(rig, -50);
  const auto listed = [&] {
    REQUIRE(rig.settle());
    const auto list = worst_elements(rig.session(), rig.bench->view_control().options());
    REQUIRE_FALSE(list.empty());
    return list.front().element;
  };
  const Index by_metric = listed();
  REQUIRE(rig.settle());
  rig.click("worst/metric");
  rig.click("worst/metric/First height over before");
  CHECK(rig.bench->view_control().options().worst_by ==
        ElementField(WallField::first_height_ratio));
  CHECK(listed() == first_by(rig.mesh(), WallField::first_height_ratio, loaded));
  set_view(rig, [](ViewOptions& view) { view.before = BeforeState::last_command; });
  CHECK(listed() == first_by(rig.mesh(), WallField::first_height_ratio, between));
  set_view(rig, [](ViewOptions& view) {
    view.worst_by.reset();
    view.color = WallField::size_ratio;
  });
  CHECK(listed() == first_by(rig.mesh(), WallField::size_ratio, loaded));
  set_view(rig, [](ViewOptions& view) { view.color = LayerField::layer; });
  CHECK(listed() == by_metric);  // gives way to the normalized Jacobian
}

TEST_CASE("a list by what no element has is empty, and says so") {
  Rig rig(1440, 1400);
  rig.open(ring_mesh());  // triangles: there are no columns of quadrilaterals
  set_view(rig, [](ViewOptions& view) { view.worst_by = WallField::growth; });
  REQUIRE(rig.settle());
  CHECK(worst_elements(rig.session(), rig.bench->view_control().options()).empty());
  CHECK_FALSE(next_worst(rig.session(), rig.bench->view_control().options(), {}, 1));
  CHECK(rig.visible("worst/list"));
}

}  // namespace winslow::gui::test
