#include <doctest/doctest.h>

#include "gui/document/selection/boundary_index.h"
#include "gui/support/actions.h"
#include "gui/support/meshes.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui::test {

TEST_CASE("a drag that starts on the outer rim pans instead of tearing the far field away") {
  const Mesh mesh = ring_mesh();
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  Camera camera;
  camera.set_viewport(0, 0, 400, 400);
  camera.look_at(Vec2(0, 0), 0.02);
  Viewport viewport;
  ActionQueue actions;
  ViewportScene scene;
  scene.boundary = &index;
  PointerState p;
  p.over = true;
  p.position = camera.to_screen(Vec2(3, 0));
  viewport.update(p, scene, camera, actions);
  p.left = true;
  viewport.update(p, scene, camera, actions);
  p.position += Vec2(-40, 0);
  viewport.update(p, scene, camera, actions);
  CHECK(viewport.gesture() == Viewport::Gesture::pan);
  CHECK(camera.centre().x() == doctest::Approx(0.8));
  for (const Action& a : actions) CHECK_FALSE(holds<action::BeginDrag>(a));

  // Selected on purpose, it moves.
  p.left = false;
  viewport.update(p, scene, camera, actions);
  scene.selection = {*mesh.topology->find_marker("farfield")};
  scene.reach = 30;  // its ring is out of the way
  p.position = camera.to_screen(Vec2(2.12132, 2.12132));
  viewport.update(p, scene, camera, actions);
  p.left = true;
  viewport.update(p, scene, camera, actions);
  p.position += Vec2(-20, 0);
  viewport.update(p, scene, camera, actions);
  CHECK(viewport.gesture() == Viewport::Gesture::move);
}

}  // namespace winslow::gui::test
