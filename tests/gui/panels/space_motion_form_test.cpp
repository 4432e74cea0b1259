#include <doctest/doctest.h>

#include "core/quality/quality.h"
#include "gui/support/moving_rig.h"

namespace winslow::gui::test {

namespace {

struct FormStudio : MovingStudio {
  FormStudio() {
    resize(1000, 1300);
    frames();
  }
  void choose(const std::string& shape) {
    click("motion/keep_outside");
    click("motion/keep_outside/" + shape);
    frames();
  }
  const KeepOutside& region() const { return session().jobs().smooth_options().keep_outside; }
  /// Interior nodes beyond a distance from the middle of the body that are elsewhere than before.
  int moved(const Coordinates& before, double radius) const {
    int count = 0;
    for (const Index node : mesh().topology->interior_nodes())
      if ((before.xyz(node) - region().centre_point()).norm() > radius)
        count += mesh().coordinates.xyz(node) != before.xyz(node);
    return count;
  }
  double worst(Metric metric) const {
    return element_value(mesh(), worst_element(mesh(), metric), metric);
  }
};

}  // namespace

TEST_CASE("In space a sphere or a box about the body is kept by the form, and drawn") {
  FormStudio studio;
  CHECK_FALSE(studio.visible("region"));
  studio.choose("Sphere");
  REQUIRE(studio.region().radius.has_value());
  REQUIRE(studio.region().centre_z.has_value());
  CHECK(studio.visible("region"));
  const double radius = *studio.region().radius;
  const Coordinates before = studio.mesh().coordinates;
  studio.fill("motion/rotate", "15");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == 2);
  CHECK(studio.moved(before, 0) > 20);
  CHECK(studio.moved(before, radius) == 0);
  studio.check_replay();

  // The third coordinate is typed like the others, and is not lost by the edit.
  studio.fill("motion/region/keep_outside_centre_z", "0.25");
  CHECK(*studio.region().centre_z == 0.25);
  studio.choose("Box");
  CHECK_FALSE(studio.region().radius.has_value());
  REQUIRE(studio.region().corner_z.has_value());
  CHECK(*studio.region().corner_z < *studio.region().opposite_z);
  CHECK(studio.visible("motion/region/keep_outside_opposite_z"));
  studio.choose("Nothing");
  CHECK_FALSE(studio.region().given());
  CHECK_FALSE(studio.visible("region"));
}

TEST_CASE("Limits of the quality of volume elements are set in the panel, and end the motion") {
  FormStudio studio;
  studio.click("motion/limits");
  studio.frames();
  // Those of volume meshes, and no others.
  CHECK(studio.visible("motion/min_quality_smallest_solid_angle/on"));
  CHECK_FALSE(studio.visible("motion/min_quality_skewness/on"));
  const double rest = studio.worst(Metric::smallest_solid_angle);
  studio.fill("motion/rotate", "60");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  const double turned = studio.worst(Metric::smallest_solid_angle);
  REQUIRE(turned < rest);
  studio.key(GLFW_KEY_Z, {keys::control});
  REQUIRE(studio.settle());
  const double limit = 0.5 * (rest + turned);
  studio.click("motion/min_quality_smallest_solid_angle/on");
  studio.frames();
  studio.fill("motion/min_quality_smallest_solid_angle", std::to_string(limit));
  studio.fill("motion/rotate", "60");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  CHECK(studio.worst(Metric::smallest_solid_angle) >= limit - 1e-5);
  REQUIRE(studio.session().messages().banner().has_value());
  CHECK(studio.session().messages().banner()->kind == Banner::Kind::partial_motion);
}

TEST_CASE("The third coordinate of a motion in the history can be changed") {
  FormStudio studio;
  studio.fill("motion/d_z", "0.02");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  set_view(studio, [](ViewOptions& view) { view.right_panel = true; });
  studio.resize(1400, 1000);
  studio.frames();
  studio.click("tab/history");
  studio.frames();
  studio.click("history/edit");
  studio.frames(3);
  studio.fill("edit/translate_z", "0.03");
  studio.click("edit/run");
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().translate.z() == doctest::Approx(0.03));
}

}  // namespace winslow::gui::test
