#include <doctest/doctest.h>

#include "core/quality/quality.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

constexpr const char* sine_switch = "motion/min_quality_normalized_jacobian/on";
constexpr const char* sine_limit = "motion/min_quality_normalized_jacobian";

double smallest_sine(const Rig& rig) {
  return element_value(rig.mesh(), worst_element(rig.mesh(), Metric::normalized_jacobian),
                       Metric::normalized_jacobian);
}

/// A ring of regular elements, its body selected and the limits unfolded.
void open_limits(Rig& rig) {
  rig.open(ring_mesh());
  SmoothOptions regular;
  regular.targets = TargetBlend::regular();
  rig.bench->apply(action::EditSmoothOptions{whole(regular)});
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  REQUIRE(rig.settle());
  rig.frames();
  rig.click("motion/limits");
  REQUIRE(rig.visible(sine_switch));
}

const QualityFloor& floor_of(const Rig& rig) {
  return rig.session().solver_settings().motion_options().floor;
}

}  // namespace

TEST_CASE("a limit of the quality is set in the panel of the motion, and ends the motion there") {
  Rig rig(1280, 1100);
  open_limits(rig);
  CHECK_FALSE(rig.visible(sine_limit));
  CHECK_FALSE(floor_of(rig).given());
  // What the motion comes to without a limit.
  const double before_motion = smallest_sine(rig);
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(2, 0)}});
  REQUIRE(rig.settle());
  const double limit = 0.5 * (before_motion + smallest_sine(rig));
  rig.bench->apply(action::Undo{});
  REQUIRE(rig.settle());
  REQUIRE(smallest_sine(rig) > limit);
  rig.frames();
  rig.click(sine_switch);
  REQUIRE(rig.visible(sine_limit));
  CHECK(floor_of(rig).given());
  rig.fill(sine_limit, std::to_string(limit));
  REQUIRE(floor_of(rig).limits[0].has_value());
  CHECK(*floor_of(rig).limits[0] == doctest::Approx(limit).epsilon(1e-5));
  const Mesh before = rig.mesh();
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(2, 0)}});
  REQUIRE(rig.settle());
  // The mesh from before the limit is kept, and the banner says where that is.
  REQUIRE(rig.document().history().size() == 3);
  CHECK(smallest_sine(rig) >= limit - 1e-5);
  CHECK((rig.mesh().coordinates == before.coordinates) == false);
  REQUIRE(rig.session().messages().banner().has_value());
  const Banner& banner = *rig.session().messages().banner();
  CHECK(banner.kind == Banner::Kind::partial_motion);
  CHECK(banner.text.starts_with("Normalized Jacobian would be less than "));
  CHECK(banner.text.find(" % of the motion: the body is where it got to.") != banner.text.npos);
  CHECK(rig.visible("banner/zoom_to_worst"));
  CHECK(rig.visible("banner/undo"));
  rig.click("banner/undo");
  REQUIRE(rig.settle());
  rig.click(sine_switch);
  CHECK_FALSE(floor_of(rig).given());
}

TEST_CASE("a limit that the mesh breaks already leaves the body where it is, and says so") {
  Rig rig(1280, 1100);
  open_limits(rig);
  MotionOptions how;
  how.floor.set(Metric::normalized_jacobian, 0.5 * (1 + smallest_sine(rig)));
  rig.bench->apply(action::EditMotionOptions{whole(how)});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.5, 0)}});
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->text.find(" at once: the body has not moved.") !=
        std::string::npos);
}

TEST_CASE("where a motion follows no path the limits say what they need") {
  MotionOptions how;
  SmoothOptions smooth;
  CHECK(follows_path(how, smooth));
  how.increments = 8;
  CHECK_FALSE(follows_path(how, smooth));
  how.increments = 0;
  how.smooth_after = false;
  CHECK_FALSE(follows_path(how, smooth));
  how.smooth_after = true;
  smooth.outer = OuterMethod::picard;
  CHECK_FALSE(follows_path(how, smooth));

  Rig rig(1280, 1100);
  open_limits(rig);
  rig.click(sine_switch);
  CHECK_FALSE(rig.visible("motion/limits/path"));
  MotionOptions steps = rig.session().solver_settings().motion_options();
  steps.increments = 8;
  rig.bench->apply(action::EditMotionOptions{whole(steps)});
  rig.frames();
  CHECK(rig.visible("motion/limits/path"));
}

TEST_CASE("the limits of a step of the history can be changed when it is edited") {
  Rig rig(1300, 1100);
  open_limits(rig);
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(1, 0)}});
  REQUIRE(rig.settle());
  const double limit = 0.5 * smallest_sine(rig);
  rig.click("tab/history");
  rig.frames(2);
  rig.click("history/edit");
  rig.frames(3);
  REQUIRE(rig.visible("edit/limits"));
  rig.click("edit/limits");
  rig.frames(2);
  REQUIRE(rig.visible("edit/min_quality_normalized_jacobian/on"));
  rig.click("edit/min_quality_normalized_jacobian/on");
  rig.frames(2);
  rig.fill("edit/min_quality_normalized_jacobian", std::to_string(limit));
  rig.click("edit/run");
  REQUIRE(rig.settle());
  const auto& move =
      std::get<MoveCommand>(rig.document().history().command(rig.document().history().position()));
  REQUIRE(move.how.floor.limits[0].has_value());
  CHECK(*move.how.floor.limits[0] == doctest::Approx(limit).epsilon(1e-4));
}

}  // namespace winslow::gui::test
