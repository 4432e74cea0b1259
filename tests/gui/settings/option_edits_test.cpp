#include "gui/settings/option_edits.h"

#include <doctest/doctest.h>

namespace winslow::gui::test {

TEST_CASE("edits of different fields made from the same options hold both, in either order") {
  const ViewOptions start;
  ViewOptions plain = start;
  plain.legend = false;
  plain.isolation.threshold = 0.25;
  ViewOptions lens = start;
  lens.magnifier.on = true;
  lens.isolation.on = true;
  ViewOptions expected = plain;
  expected.magnifier.on = true;
  expected.isolation.on = true;
  const auto one = difference(start, plain);
  const auto other = difference(start, lens);
  ViewOptions forth = start, back = start;
  one.apply_to(forth);
  other.apply_to(forth);
  other.apply_to(back);
  one.apply_to(back);
  CHECK(forth == expected);
  CHECK(back == expected);
}

TEST_CASE("an edit back to the default is an edit; an edit of nothing is empty") {
  ViewOptions start;
  start.color.reset();
  start.worst_count = 50;
  ViewOptions after = start;
  CHECK(difference(start, after).empty());
  after.color = ViewOptions().color;
  const auto edit = difference(start, after);
  CHECK_FALSE(edit.empty());
  edit.apply_to(start);
  CHECK(start.color == ViewOptions().color);
  CHECK(start.worst_count == 50);
}

TEST_CASE("an edit of everything leaves nothing as it was") {
  SmoothOptions start;
  start.formulation = "pointwise";
  start.linear.restart = 7;
  start.threads = 3;
  whole(SmoothOptions()).apply_to(start);
  CHECK(start.formulation == SmoothOptions().formulation);
  CHECK(start.linear == LinearOptions());
  CHECK(start.threads == 0);
}

TEST_CASE("options of the solver and of motions are edited field by field, too") {
  SmoothOptions smooth;
  SmoothOptions damped = smooth, long_run = smooth;
  damped.damping = 0.1;
  long_run.max_iterations = 9;
  difference(SmoothOptions(), damped).apply_to(smooth);
  difference(SmoothOptions(), long_run).apply_to(smooth);
  CHECK(smooth.damping == 0.1);
  CHECK(smooth.max_iterations == 9);
  MotionOptions motion;
  difference(MotionOptions(), MotionOptions{8, true}).apply_to(motion);
  difference(MotionOptions(), MotionOptions{0, false}).apply_to(motion);
  CHECK(motion.increments == 8);
  CHECK_FALSE(motion.smooth_after);
}

}  // namespace winslow::gui::test
