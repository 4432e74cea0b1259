#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// The tooltip of a widget on which the mouse rests; none: it has none.
std::optional<WidgetMap::Rect> tooltip_of(Rig& rig, const std::string& widget) {
  const auto rect = rig.bench->widgets().find(widget);
  REQUIRE(rect.has_value());
  rig.move(rect->centre());
  rig.frames(20);
  return rig.bench->widgets().find("tooltip");
}

}  // namespace

TEST_CASE("a tooltip covers neither its widget nor the rows beside it") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  const Layout& layout = rig.bench->layout();
  for (const char* widget : {"marker/flap", "solver/advanced", "section/motion", "solver/method"}) {
    INFO(widget);
    const auto tip = tooltip_of(rig, widget);
    if (std::string(widget) == "section/motion") {
      CHECK_FALSE(tip.has_value());
      continue;
    }
    REQUIRE(tip.has_value());
    CHECK(tip->min.x() >= static_cast<double>(layout.left.x + layout.left.width));
  }
  for (const char* widget : {"tab/view", "quality/before"}) {
    INFO(widget);
    const auto tip = tooltip_of(rig, widget);
    REQUIRE(tip.has_value());
    CHECK(tip->max.x() <= static_cast<double>(layout.right.x));
  }
  // Of the toolbar: below it.
  const auto tip = tooltip_of(rig, "tool/fit");
  REQUIRE(tip.has_value());
  CHECK(tip->min.y() >= rig.bench->widgets().find("tool/fit")->max.y());
}

TEST_CASE("every tooltip waits for the mouse to rest") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  rig.move(rig.bench->widgets().find("tool/fit")->centre());
  rig.frames(3);
  CHECK_FALSE(rig.visible("tooltip"));
  rig.frames(20);
  CHECK(rig.visible("tooltip"));
  rig.move(rig.bench->widgets().find("tool/palette")->centre());
  rig.frames(3);
  CHECK_FALSE(rig.visible("tooltip"));
}

}  // namespace winslow::gui::test
