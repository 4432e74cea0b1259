#include <doctest/doctest.h>

#include "gui/document/autosave/step_file.h"
#include "gui/document/history/document.h"
#include "gui/support/meshes.h"
#include "support/surface_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a step of a surface mesh comes back, with the shape that its nodes stay on") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(winslow::test::octasphere(4));
  Document::Loaded loaded;
  loaded.state = make_state(mesh);
  examine(loaded);
  REQUIRE(loaded.state.surface);
  REQUIRE(loaded.given);
  REQUIRE(loaded.boundary);
  CHECK(loaded.given->to(Vec3(0, 0, 1)) < 1e-15);
  MeshState second = loaded.state;
  second.mesh.coordinates.set_xyz(3, Vec3(0, 0, 2));
  write_step(folder / "second.bin", second, loaded.state, {});
  const MeshState next = read_step(folder / "second.bin", loaded.state).state;
  CHECK(next.mesh.coordinates == second.mesh.coordinates);
  CHECK(next.surface == loaded.state.surface);
  CHECK(next.vcv == loaded.state.vcv);
}

}  // namespace winslow::gui::test
