#include <doctest/doctest.h>

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "gui/studio/boundary_index.h"
#include "gui/studio/input.h"
#include "gui/studio/keys.h"
#include "gui/studio/meshes.h"
#include "gui/studio/text.h"
#include "gui/studio/viewport.h"

namespace winslow::gui::test {

TEST_CASE("a press and its release never fall into one frame") {
  InputQueue queue;
  queue.move(Vec2(3, 4));
  queue.button(MouseButton::left, true);
  queue.button(MouseButton::left, false);
  const InputState down = queue.next_frame();
  CHECK(down.down(MouseButton::left));
  CHECK(down.mouse == Vec2(3, 4));
  CHECK_FALSE(queue.empty());
  CHECK_FALSE(queue.next_frame().down(MouseButton::left));
  CHECK(queue.empty());
}

TEST_CASE("a motion after a press waits for the next frame") {
  InputQueue queue;
  queue.button(MouseButton::left, true);
  queue.move(Vec2(9, 9));
  queue.wheel(Vec2(0, 1));
  CHECK(queue.next_frame().mouse != Vec2(9, 9));
  const InputState next = queue.next_frame();
  CHECK(next.mouse == Vec2(9, 9));
  CHECK(next.wheel.y() == 1);
  CHECK(queue.next_frame().wheel.y() == 0);
}

TEST_CASE("keys and text are counted once") {
  InputQueue queue;
  queue.key(keys::control, true);
  queue.key(keys::z, true);
  queue.text(U'x');
  queue.key(keys::z, false);
  const InputState first = queue.next_frame();
  CHECK(first.control());
  CHECK(first.keys[keys::z]);
  CHECK(first.text == U"x");
  const InputState second = queue.next_frame();
  CHECK_FALSE(second.keys[keys::z]);
  CHECK(second.text.empty());
  queue.key(-1, true);  // a key that GLFW does not know
  CHECK(queue.empty());
}

TEST_CASE("Control that goes up before its key still counts") {
  InputQueue queue;
  queue.key(keys::control, true);
  CHECK(queue.next_frame().control());
  // Both in one frame: a fast hand, or a program that types.
  queue.key(keys::q, true);
  queue.key(keys::control, false);
  queue.key(keys::q, false);
  const InputState pressed = queue.next_frame();
  CHECK(pressed.keys[keys::q]);
  CHECK(pressed.control());
  CHECK_FALSE(queue.next_frame().control());
  // Nor does Control that comes after a key or a button belong to it.
  queue.key(keys::w, true);
  queue.key(keys::control, true);
  CHECK_FALSE(queue.next_frame().control());
  queue.button(MouseButton::left, true);
  queue.key(keys::control, false);
  CHECK(queue.next_frame().control());
}

TEST_CASE("composed rigid motions act one after the other") {
  const RigidMotion first{30, Vec2(1, 2), Vec2(0.5, -0.25)};
  for (const RigidMotion& second :
       {RigidMotion{-75, Vec2(-3, 0.5), Vec2(0.1, 0.2)}, RigidMotion{0, Vec2(9, 9), Vec2(1, 1)}}) {
    const RigidMotion total = compose(first, second);
    for (const Vec2& p : {Vec2(0, 0), Vec2(4, -1), Vec2(-2, 7)}) {
      CHECK((transform(total, p) - transform(second, transform(first, p))).norm() < 1e-12);
      CHECK((transform_back(first, transform(first, p)) - p).norm() < 1e-12);
    }
  }
  CHECK(compose({0, {0, 0}, {1, 0}}, {0, {5, 5}, {0, 1}}).rotate == 0);
}

TEST_CASE("the boundary index finds rims, holes and nothing") {
  const Mesh mesh = two_body_mesh();
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  const Index left = *mesh.topology->find_marker("left");
  const Index outer = *mesh.topology->find_marker("outer");

  const auto rim = index.pick(Vec2(-1.45, 0.2), 0.1);
  REQUIRE(rim.has_value());
  CHECK(rim->marker == left);
  CHECK(rim->hole);
  CHECK_FALSE(rim->inside);
  const auto inside = index.pick(Vec2(-2, 0), 0.1);
  REQUIRE(inside.has_value());
  CHECK(inside->inside);
  CHECK(inside->markers == std::vector<Index>{left});
  const auto edge = index.pick(Vec2(1, 2.05), 0.1);
  REQUIRE(edge.has_value());
  CHECK(edge->marker == outer);
  CHECK_FALSE(edge->hole);
  CHECK_FALSE(index.pick(Vec2(0, 0), 0.1).has_value());
  CHECK_FALSE(index.pick(Vec2(20, 0), 0.1).has_value());

  Coordinates moved = mesh.coordinates;
  for (Index node : mesh.topology->marker_nodes(left))
    moved.set_xy(node, moved.xy(node) + Vec2(1.5, 0));
  index.update(moved);
  CHECK_FALSE(index.pick(Vec2(-2.4, 0), 0.05).has_value());
  REQUIRE(index.pick(Vec2(-0.5, 0), 0.05).has_value());
  CHECK(index.pick(Vec2(-0.5, 0), 0.05)->marker == left);
}

TEST_CASE("the nearest boundary edge is the one a search through all of them finds") {
  const Mesh mesh = ring_mesh(60, 3);
  BoundaryIndex index(mesh.topology);
  index.update(mesh.coordinates);
  const Index flap = *mesh.topology->find_marker("flap");
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.1 * k;
    const double radius = 0.2 + 0.013 * k;
    const Vec2 p(radius * std::cos(angle), radius * std::sin(angle));
    double nearest[2] = {1e9, 1e9};
    for (Index m = 0; m < 2; ++m)
      for (const auto& [a, b] : mesh.topology->markers()[static_cast<std::size_t>(m)].edges) {
        const Vec2 s = mesh.coordinates.xy(a);
        const Vec2 d = mesh.coordinates.xy(b) - s;
        const double t = std::clamp((p - s).dot(d) / d.squaredNorm(), 0.0, 1.0);
        nearest[m] = std::min(nearest[m], (p - s - t * d).norm());
      }
    const auto hit = index.pick(p, 10);
    REQUIRE(hit.has_value());
    CHECK(hit->marker == (nearest[flap] < nearest[1 - flap] ? flap : 1 - flap));
  }
}

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
  for (const Action& a : actions) CHECK_FALSE(std::holds_alternative<action::BeginDrag>(a));

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

TEST_CASE("numbers are written as people read them") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(1234567) == "1,234,567");
  CHECK(grouped(-1000) == "-1,000");
  CHECK(counted(1, "node") == "1 node");
  CHECK(counted(4774, "node") == "4,774 nodes");
  CHECK(table_number(0.8661) == "0.866");
  CHECK(table_number(12345.6) == "1.23e+04");
  CHECK(table_number(1.0 / 0.0) == "-");
}

}  // namespace winslow::gui::test
