#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

/// Labels that do not fit into their button, list or panel.
void check_space_labels(const Rig& rig) {
  for (const auto& widget : rig.bench->widgets().all()) {
    INFO("widget ", widget.first);
    CHECK_FALSE(widget.second.cut);
  }
}

/// Opens every column and every tab in turn.
void check_space_panels(Rig& rig) {
  for (const SideTab tab : {SideTab::quality, SideTab::view, SideTab::vcv, SideTab::history}) {
    INFO("tab ", static_cast<int>(tab));
    set_view(rig, [&](ViewOptions& view) {
      view.right_panel = true;
      view.side_tab = tab;
    });
    check_space_labels(rig);
  }
  set_view(rig, [](ViewOptions& view) {
    view.left_panel = true;
    view.right_panel = false;
  });
  REQUIRE(rig.visible("motion/apply"));
  check_space_labels(rig);
  set_view(rig, [](ViewOptions& view) { view.left_panel = view.right_panel = false; });
  check_space_labels(rig);
}

}  // namespace

TEST_CASE("in space no button, list or switch cuts its label, at any size and scale") {
  struct Screen {
    int width, height;
    float scale;
  };
  Rig rig(1500, 2200);
  rig.open(winslow::test::box_with_body(5, winslow::test::Volumes::tetrahedra));
  rig.bench->apply(action::InspectNode{rig.mesh().topology->interior_nodes()[20]});
  rig.bench->apply(action::SelectMarkers{{rig.marker("body")}});
  rig.click("marker_role/far");
  REQUIRE(rig.settle());
  // All that is folded at first, from below so that nothing moves before it is clicked.
  for (const char* part : {"section/mesh", "section/measures", "solver/advanced", "section/cuts",
                           "section/peel", "section/shape", "motion/limits"}) {
    if (!rig.visible(part)) continue;
    rig.click(part);
    REQUIRE(rig.settle());
  }
  rig.click("motion/keep_outside");
  rig.click("motion/keep_outside/Box");
  rig.frames(2);
  REQUIRE(rig.visible("motion/min_quality_smallest_solid_angle/on"));
  REQUIRE(rig.visible("motion/region/keep_outside_corner_z"));
  REQUIRE(rig.visible("markers/features"));
  for (const Screen& s : {Screen{760, 480, 1}, Screen{1024, 640, 1}, Screen{1440, 900, 1.5f},
                          Screen{1920, 1080, 2}}) {
    INFO(s.width, " x ", s.height, " at ", s.scale);
    rig.resize(s.width, s.height);
    rig.bench->set_scale(s.scale);
    rig.frames(4);
    REQUIRE(rig.settle());
    check_space_panels(rig);
  }
}

}  // namespace winslow::gui::test
