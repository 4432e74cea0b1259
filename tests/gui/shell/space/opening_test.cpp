#include <doctest/doctest.h>

#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a large volume mesh is in the picture before its quality is measured for colours") {
  Rig rig(760, 480);
  const Mesh mesh = winslow::test::shaken_box(12, 0.1, 3);  // made in the background
  rig.bench->apply(action::OpenMesh{write(rig.folder, mesh, "box.su2")});
  const MeshView& view = rig.bench->pane().mesh_view();
  while (!view.shown()) {
    CHECK_FALSE(rig.session().quality().busy());
    CHECK(rig.session().quality().latest() == nullptr);
    CHECK_FALSE(rig.bench->settled());
    rig.frames(1);
  }
  REQUIRE(rig.settle());
  REQUIRE(rig.session().quality().latest() != nullptr);
  CHECK(rig.session().quality().latest()->shape == rig.session().shape());
  CHECK(view.volume().legend().has_value());
}

}  // namespace winslow::gui::test
