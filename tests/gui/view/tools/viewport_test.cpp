#include <doctest/doctest.h>

#include "gui/document/selection/boundary_index.h"
#include "gui/support/meshes.h"
#include "gui/support/rig.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui::test {

TEST_CASE("a drag that starts on the outer rim pans instead of tearing the far field away") {
  const Mesh mesh = ring_mesh();
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  Camera camera;
  camera.set_viewport(0, 0, 400, 400);
  camera.look_at(Vec2(0, 0), 0.02);
  PlaneView view(camera);
  Viewport viewport;
  ActionQueue actions;
  ViewportScene scene;
  scene.boundary = &index;
  PointerState p;
  p.over = true;
  p.position = view.to_screen(Vec2(3, 0));
  viewport.update(p, scene, view, actions);
  p.left = true;
  viewport.update(p, scene, view, actions);
  p.position = p.position + ScreenVector(-40, 0);
  viewport.update(p, scene, view, actions);
  CHECK(viewport.gesture() == Viewport::Gesture::pan);
  CHECK(view.camera().centre().x() == doctest::Approx(0.8));
  for (const Action& a : actions) CHECK_FALSE(holds<action::BeginDrag>(a));

  // Selected on purpose, it moves.
  p.left = false;
  viewport.update(p, scene, view, actions);
  scene.selection = {*mesh.topology->markers().find("farfield")};
  scene.reach = 30;  // its ring is out of the way
  p.position = view.to_screen(Vec2(2.12132, 2.12132));
  viewport.update(p, scene, view, actions);
  p.left = true;
  viewport.update(p, scene, view, actions);
  p.position = p.position + ScreenVector(-20, 0);
  viewport.update(p, scene, view, actions);
  CHECK(viewport.gesture() == Viewport::Gesture::move);
}

}  // namespace winslow::gui::test
