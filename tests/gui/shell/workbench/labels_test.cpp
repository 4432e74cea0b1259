#include <doctest/doctest.h>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Labels that do not fit into their button, list or panel, in the columns as they are.
void check_labels(Rig& rig) {
  for (const auto& widget : rig.bench->widgets().all()) {
    INFO("widget ", widget.first);
    CHECK_FALSE(widget.second.cut);
  }
}

void check_tabs(Rig& rig) {
  check_labels(rig);
  for (const SideTab tab : {SideTab::quality, SideTab::view, SideTab::vcv, SideTab::history}) {
    INFO("tab ", static_cast<int>(tab));
    set_view(rig, [&](ViewOptions& view) {
      view.right_panel = true;
      view.side_tab = tab;
    });
    check_labels(rig);
  }
  // Where there is no room for both columns the left one takes the place of the right.
  set_view(rig, [](ViewOptions& view) {
    view.left_panel = true;
    view.right_panel = false;
  });
  REQUIRE(rig.visible("layers/insert"));
  check_labels(rig);
}

}  // namespace

TEST_CASE("no button, list or switch cuts its label, at any size and scale") {
  struct Screen {
    int width, height;
    float scale;
  };
  Rig rig(1280, 1800);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  REQUIRE(rig.settle());
  // All that is folded at first, from below so that nothing moves before it is clicked.
  for (const char* part :
       {"section/mesh", "solver/advanced", "section/layers", "section/shape", "motion/limits"}) {
    INFO(part);
    if (!rig.visible(part)) continue;
    rig.click(part);
    REQUIRE(rig.settle());
  }
  REQUIRE(rig.visible("layers/insert"));
  REQUIRE(rig.visible("shape/fade"));
  REQUIRE(rig.visible("solver/defaults"));
  REQUIRE(rig.visible("motion/min_quality_skewness/on"));
  for (const Screen& s : {Screen{760, 480, 1}, Screen{1024, 768, 1}, Screen{1200, 750, 1},
                          Screen{1280, 720, 1}, Screen{1440, 900, 1}, Screen{1440, 900, 1.5f},
                          Screen{1024, 768, 1.5f}, Screen{1920, 1080, 2}, Screen{2560, 1440, 2}}) {
    INFO(s.width, " x ", s.height, " at ", s.scale);
    rig.resize(s.width, s.height);
    rig.bench->set_scale(s.scale);
    rig.frames(4);
    REQUIRE(rig.settle());
    check_tabs(rig);
  }
}

}  // namespace winslow::gui::test
