#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

/// Drags the selected body along x by its arrow, and waits for the mesh.
void drag_along_x(Rig& rig, double pixels) {
  const auto arrow = rig.bench->widgets().find("gizmo/arrow/x");
  REQUIRE(arrow.has_value());
  const auto along = rig.bench->widgets().find("gizmo/arrow/x")->centre();
  const View& view = rig.bench->view_control().view();
  const ScreenPoint root = view.project(rig.session().selection().space_pivot()).at;
  const ScreenVector way = (along - root) / (along - root).norm();
  rig.drag(along, along + pixels * way);
  REQUIRE(rig.wait([&] {
    return rig.session().mesh().body_drag() == nullptr ||
           rig.session().mesh().body_drag()->settled();
  }));
  rig.release();
  REQUIRE(rig.settle());
}

}  // namespace

TEST_CASE("after a crash a volume mesh comes back as a drag has left it, to the bit") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  const Mesh mesh = winslow::test::box_with_body(5, winslow::test::Volumes::tetrahedra);
  std::vector<Coordinates> positions;
  std::string description;
  {
    Rig rig(1000, 760, profile.path());
    rig.bench->apply(action::OpenMesh{write(meshes, mesh, "box.su2")});
    REQUIRE(rig.settle());
    set_view(rig, [](ViewOptions& view) { view.left_panel = true; });
    rig.click("marker/body");
    rig.key(GLFW_KEY_7);
    rig.frames();
    positions.push_back(rig.mesh().coordinates);
    for (const double pixels : {40.0, -25.0}) {
      drag_along_x(rig, pixels);
      positions.push_back(rig.mesh().coordinates);
    }
    REQUIRE(rig.document().history().size() == 3);
    REQUIRE(positions[1] != positions[0]);
    REQUIRE(positions[2] != positions[1]);
    description = describe(rig.document().history().command(2));
    rig.key(keys::z, {keys::control});
    REQUIRE(rig.settle());
    REQUIRE(rig.wait([&] { return !rig.bench->autosave().busy(); }));
  }  // as if it were killed
  Rig rig(1000, 760, profile.path());
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  rig.frames(3);
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
  REQUIRE(rig.settle());
  CHECK(rig.session().in_space());
  REQUIRE(rig.document().history().size() == 3);
  CHECK(rig.document().history().position() == 1);
  CHECK(rig.mesh().coordinates == positions[1]);
  CHECK(describe(rig.document().history().command(2)) == description);
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  CHECK(rig.mesh().coordinates == positions[0]);
  for (int k = 0; k < 2; ++k) rig.key(keys::z, {keys::control, keys::shift});
  REQUIRE(rig.settle());
  CHECK(rig.mesh().coordinates == positions[2]);
  // It can be gone on with: the same body is dragged from there.
  set_view(rig, [](ViewOptions& view) { view.left_panel = true; });
  rig.click("marker/body");
  rig.key(GLFW_KEY_7);
  rig.frames();
  drag_along_x(rig, 30);
  CHECK(rig.document().history().size() == 4);
}

}  // namespace winslow::gui::test
