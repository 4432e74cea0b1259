#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

#include "gui/document/jobs/run_settings.h"
#include "gui/support/rig.h"
#include "gui/support/space_rig.h"

namespace winslow::gui::test {

namespace {

void choose(Rig& rig, const std::string& combo, const std::string& item) {
  rig.click(combo);
  rig.click(combo + "/" + item);
}

void choose_direct(Rig& rig) { choose(rig, "solver/method", "Direct (the paper's)"); }

/// Turns the flap so far that the mesh is tangled at first.
void turn(Rig& rig, double degrees) {
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{degrees, Vec2(0, 0), Vec2(0, 0)}});
}

Index inverted_on_screen(const Rig& rig) {
  return check_validity(*rig.mesh().topology, rig.session().coordinates()).inverted;
}

}  // namespace

TEST_CASE("the method is one choice that sets formulation, iteration and steps") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  CHECK(method_of(rig.session().solver_settings().smooth_options(),
                  rig.session().solver_settings().motion_options()) == Method::path);
  CHECK_FALSE(rig.visible("solver/pace"));
  choose_direct(rig);
  CHECK(rig.session().solver_settings().smooth_options().formulation == Formulation::pointwise);
  CHECK(rig.session().solver_settings().smooth_options().outer == OuterMethod::picard);
  CHECK(rig.session().solver_settings().motion_options().increments == 1);
  CHECK(rig.visible("solver/pace"));
  choose(rig, "solver/method", "Path following");
  CHECK(method_of(rig.session().solver_settings().smooth_options(),
                  rig.session().solver_settings().motion_options()) == Method::path);
  CHECK(rig.session().solver_settings().smooth_options().formulation == Formulation::variational);
  CHECK_FALSE(rig.visible("solver/pace"));
}

TEST_CASE("the direct method takes back a linear solver that it cannot use") {
  SmoothOptions smooth;
  MotionOptions motion;
  smooth.linear.solver = "multigrid";
  use_method(Method::direct, smooth, motion);
  CHECK_NOTHROW(validate(smooth));
  use_method(Method::path, smooth, motion);
  CHECK_NOTHROW(validate(smooth));
  motion.increments = 8;
  CHECK(method_of(smooth, motion) == Method::custom);
}

TEST_CASE("the direct method shows tangled meshes on its way to a valid one") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  choose_direct(rig);
  choose(rig, "solver/pace", "5 a second");
  turn(rig, 75);
  rig.bench->apply(action::StepSolver{2});
  REQUIRE(rig.wait([&] { return solver_paused(rig); }));
  CHECK(inverted_on_screen(rig) > 0);
  CHECK(rig.session().mesh().convergence().back().inverted == inverted_on_screen(rig));
  // The boundary is at its place from the first iteration on.
  const Index node = rig.mesh().topology->markers().nodes(rig.marker("flap"))[0];
  const Vec2 rest = rig.mesh().coordinates.xy(node);
  const Vec2 now = rig.session().coordinates().xy(node);
  CHECK(rest.dot(now) == doctest::Approx(std::cos(pi * 75 / 180) * rest.squaredNorm()));
  choose(rig, "solver/pace", "Unlimited");
  rig.click("tool/run");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.document().history().result(1).inverted == 0);
  CHECK(rig.document().history().result(1).increments == 1);
}

TEST_CASE("a paced direct run goes no faster, and can be slowed, cancelled and sped up at once") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  const Coordinates before = rig.mesh().coordinates;
  choose_direct(rig);
  const SmoothOptions usual = rig.session().solver_settings().smooth_options();
  SmoothOptions slow = usual;  // it would go on for minutes
  slow.damping = 0.001;
  slow.acceleration = 0;
  slow.max_iterations = 100000;
  rig.bench->apply(action::EditSmoothOptions{whole(slow)});
  choose(rig, "solver/pace", "30 a second");
  CHECK(rig.session().jobs().pace() == 30);
  const auto start = std::chrono::steady_clock::now();
  turn(rig, 120);
  REQUIRE(rig.wait([&] { return iterations(rig) >= 6; }));
  // Never faster than that; how much slower is up to the machine.
  CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(5 * 33));
  choose(rig, "solver/pace", "1 a second");
  REQUIRE(rig.session().job().active());
  rig.click("tool/cancel");
  CHECK_FALSE(rig.session().job().active());
  CHECK(rig.session().coordinates() == before);
  rig.bench->apply(action::EditSmoothOptions{whole(usual)});
  turn(rig, 60);
  choose(rig, "solver/pace", "Unlimited");
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("Step N runs as many iterations as its field says") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  SmoothOptions slow;
  slow.formulation = Formulation::pointwise;
  slow.outer = OuterMethod::picard;
  slow.damping = 0.01;
  rig.bench->apply(action::EditSmoothOptions{whole(slow)});
  rig.fill("solver/steps", "4");
  rig.click("solver/step_n");
  REQUIRE(rig.wait([&] { return solver_paused(rig) && iterations(rig) == 4; }));
  rig.fill("solver/steps", "-3");
  rig.click("solver/step_n");
  REQUIRE(rig.wait([&] { return solver_paused(rig) && iterations(rig) == 5; }));
  CHECK(rig.session().job().paused());
}

TEST_CASE("both resets: to before this motion, and to the mesh as loaded") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  const Coordinates loaded = rig.mesh().coordinates;
  CHECK_FALSE(rig.bench->widgets().find("solver/reset_motion")->enabled);
  CHECK_FALSE(rig.bench->widgets().find("solver/reset_loaded")->enabled);
  turn(rig, 20);
  REQUIRE(rig.settle());
  const Coordinates first = rig.mesh().coordinates;
  turn(rig, 20);
  REQUIRE(rig.settle());
  rig.click("solver/reset_motion");
  CHECK(rig.session().coordinates() == first);
  // A motion under way is undone as well.
  choose_direct(rig);
  choose(rig, "solver/pace", "1 a second");
  turn(rig, 75);
  REQUIRE(rig.wait([&] { return iterations(rig) >= 1; }));
  CHECK(rig.session().coordinates() != first);
  rig.click("solver/reset_motion");
  CHECK_FALSE(rig.session().job().active());
  CHECK(rig.session().coordinates() == first);
  rig.click("solver/reset_loaded");
  CHECK(rig.session().coordinates() == loaded);
  CHECK(rig.document().history().size() == 3);
}

TEST_CASE("what does not apply is not shown, and the defaults come back at a press") {
  Rig rig(1280, 1400);
  rig.open(ring_mesh());
  CHECK_FALSE(rig.visible("solver/tolerance"));
  rig.click("solver/advanced");
  REQUIRE(rig.visible("solver/tolerance"));
  CHECK(rig.visible("solver/targets"));
  CHECK_FALSE(rig.visible("solver/acceleration"));
  CHECK_FALSE(rig.visible("solver/linear_tolerance"));
  choose_direct(rig);
  CHECK_FALSE(rig.visible("solver/targets"));
  CHECK_FALSE(rig.visible("solver/untangle"));
  CHECK(rig.visible("solver/acceleration"));
  rig.click("solver/linear");
  CHECK_FALSE(rig.visible("solver/linear/multigrid"));
  rig.click("solver/linear/gmres");
  CHECK(rig.session().solver_settings().smooth_options().linear.solver == "gmres");
  CHECK(rig.visible("solver/linear_restart"));
  rig.fill("solver/tolerance", "1e-6");
  CHECK(rig.session().solver_settings().smooth_options().tolerance == 1e-6);
  // The default, entered, is none of the user's: a recipe does not name it.
  rig.fill("solver/tolerance", "1e-10");
  CHECK_FALSE(rig.session().solver_settings().smooth_options().tolerance);
  rig.fill("solver/tolerance", "1e-4");
  CHECK(rig.session().solver_settings().smooth_options().tolerance == 1e-4);
  rig.click("solver/adapt_damping");
  CHECK_FALSE(rig.session().solver_settings().smooth_options().adapt_damping);
  rig.click("solver/defaults");
  CHECK(method_of(rig.session().solver_settings().smooth_options(),
                  rig.session().solver_settings().motion_options()) == Method::path);
  CHECK(rig.session().solver_settings().smooth_options().tolerance == SmoothOptions{}.tolerance);
  CHECK(rig.session().solver_settings().smooth_options().adapt_damping);
  CHECK(rig.session().solver_settings().smooth_options().linear == LinearOptions{});
}

TEST_CASE("the solver's tolerance in effect is that of the open mesh, until one is entered") {
  LookingRig rig({}, 1400, 1300);
  const auto given = [&] { return rig.session().solver_settings().smooth_options().tolerance; };
  rig.click("solver/advanced");
  rig.frames();
  rig.fill("solver/tolerance", "1e-10");
  CHECK(given() == 1e-10);
  rig.fill("solver/tolerance", "1e-4");  // the default of volume meshes
  CHECK_FALSE(given());
  rig.open(ring_mesh());
  rig.frames();
  rig.fill("solver/tolerance", "1e-4");
  CHECK(given() == 1e-4);
  rig.open(LookingRig::cavity());
  rig.frames();
  CHECK(given() == 1e-4);  // it was given, so it stays
}

/// The solver's panel of surface meshes.

TEST_CASE("the solver's options of a surface mesh leave out what such a mesh refuses") {
  SurfaceRig rig;
  rig.click("solver/advanced");
  rig.frames();
  for (const char* id : {"solver/targets", "solver/exponent", "solver/linear", "solver/tolerance",
                         "solver/feature-angle"})
    CHECK_MESSAGE(rig.visible(id), id);
  for (const char* id : {"solver/formulation", "solver/outer", "solver/untangle", "solver/damping",
                         "solver/adapt_damping", "solver/clip", "solver/keep-outside",
                         "solver/slide", "solver/periodic", "solver/surface-first"})
    CHECK_MESSAGE(!rig.visible(id), id);
  // A plane mesh has them.
  rig.open(ring_mesh(), "plane.su2");
  rig.frames();
  for (const char* id : {"solver/formulation", "solver/untangle", "solver/damping"})
    CHECK_MESSAGE(rig.visible(id), id);
  CHECK_FALSE(rig.visible("solver/feature-angle"));
}

TEST_CASE("a surface mesh that is opened after the paper's method is smoothed all the same") {
  SurfaceRig rig;
  rig.open(ring_mesh(), "plane.su2");
  rig.click("solver/method");
  rig.click("solver/method/Direct (the paper's)");
  CHECK(rig.session().solver_settings().smooth_options().formulation == Formulation::pointwise);
  rig.open(SurfaceRig::ball(), "ball.obj");
  CHECK(rig.session().solver_settings().smooth_options().formulation == Formulation::variational);
  rig.scramble();
  rig.click("tool/run");
  REQUIRE(rig.settle());
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().position() == 2);
  CHECK(rig.document().history().result(2).converged);
}

}  // namespace winslow::gui::test
