#include "gui/view/tools/viewport.h"

#include <doctest/doctest.h>

#include <cmath>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Of the rim around the mesh, beside the handle.
ScreenPoint on_rim(const Rig& rig) {
  const double angle = radians(20);
  return rig.pixel(3 * Vec2(std::cos(angle), std::sin(angle)));
}

}  // namespace

TEST_CASE("a drag that starts on the outer rim pans instead of tearing the far field away") {
  Rig rig;
  rig.open(ring_mesh());
  const Viewport& viewport = rig.bench->pane().viewport();
  const Camera& camera = rig.bench->view_control().camera();
  const Vec2 centre = camera.centre();
  rig.drag(on_rim(rig), on_rim(rig) + ScreenVector(-40, 0));
  CHECK(viewport.gesture() == Viewport::Gesture::pan);
  CHECK(camera.centre().x() ==
        doctest::Approx(centre.x() + 40 * camera.units_per_pixel()).epsilon(1e-9));
  CHECK_FALSE(rig.session().dragging());
  rig.release();

  // Selected on purpose, it moves.
  rig.bench->apply(action::SelectMarkers{{rig.marker("farfield")}});
  rig.frames();
  rig.drag(on_rim(rig), on_rim(rig) + ScreenVector(-20, 0));
  CHECK(viewport.gesture() == Viewport::Gesture::move);
  CHECK(rig.session().dragging());
  rig.key(keys::escape);
  rig.release();
  CHECK(rig.settle());
}

TEST_CASE("Esc puts a pan back") {
  Rig rig;
  rig.open(ring_mesh());
  const Camera& camera = rig.bench->view_control().camera();
  const Vec2 centre = camera.centre();
  const ScreenPoint from = rig.pixel(Vec2(0, 1.5));
  rig.drag(from, from + ScreenVector(30, 20), 6, MouseButton::middle);
  CHECK((camera.centre() - centre).norm() > 20 * camera.units_per_pixel());
  rig.key(keys::escape);
  CHECK((camera.centre() - centre).norm() < 1e-12);
  rig.release(MouseButton::middle);
}

}  // namespace winslow::gui::test
