#include <doctest/doctest.h>

#include "gui/support/surface_rig.h"

/// The solver's panel of surface meshes.
namespace winslow::gui::test {

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
  CHECK(rig.session().jobs().smooth_options().formulation == "pointwise");
  rig.open(SurfaceRig::ball(), "ball.obj");
  CHECK(rig.session().jobs().smooth_options().formulation == "variational");
  rig.scramble();
  rig.click("tool/run");
  REQUIRE(rig.settle());
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().position() == 2);
  CHECK(rig.document().history().result(2).converged);
}

}  // namespace winslow::gui::test
