#include <doctest/doctest.h>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

void choose(Rig& rig, const std::string& shape) {
  rig.click("motion/keep_outside");
  rig.click("motion/keep_outside/" + shape);
}

const KeepOutside& region(const Rig& rig) {
  return rig.session().jobs().smooth_options().keep_outside;
}

/// Interior nodes that are elsewhere than before, of those within that distance of the origin or
/// of those beyond it.
int moved(const Rig& rig, const Coordinates& before, double radius, bool within) {
  int count = 0;
  for (const Index node : rig.mesh().topology->interior_nodes()) {
    const Vec2 at = before.xy(node);
    if ((at.norm() <= radius) == within) count += rig.mesh().coordinates.xy(node) != at;
  }
  return count;
}

}  // namespace

TEST_CASE("a circle is kept around the body by the form") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  CHECK_FALSE(rig.visible("motion/region/keep_outside_radius"));
  choose(rig, "Circle");
  REQUIRE(region(rig).radius);
  rig.fill("motion/region/keep_outside_radius", "1.5");
  REQUIRE(*region(rig).radius == 1.5);
  const Coordinates before = rig.mesh().coordinates;
  turn_flap(rig, 15);
  CHECK(moved(rig, before, 1.5, true) > 20);
  CHECK(moved(rig, before, 1.5, false) == 0);
  // Smoothing in place has no body about which the circle could be.
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 3);
  CHECK(moved(rig, before, 1.5, false) == 0);

  choose(rig, "Box");
  CHECK_FALSE(region(rig).radius);
  CHECK(region(rig).corner);
  CHECK(rig.visible("motion/region/keep_outside_corner_x"));
  choose(rig, "Nothing");
  CHECK_FALSE(region(rig).given());
  CHECK_FALSE(rig.visible("motion/region/keep_outside_corner_x"));
}

TEST_CASE("the region of one mesh is not that of the next") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  choose(rig, "Circle");
  REQUIRE(region(rig).given());
  rig.open(ring_mesh(), "other.su2");
  CHECK_FALSE(region(rig).given());
}

}  // namespace winslow::gui::test
