#include <doctest/doctest.h>

#include "gui/document/autosave/step_file.h"
#include "gui/support/meshes.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a step of a volume mesh comes back, alone and after another") {
  using winslow::test::Volumes;
  const TemporaryFolder folder;
  const MeshState first = make_state(make_mesh(winslow::test::cube_with_cavity(6, Volumes::mixed)));
  write_step(folder / "first.bin", first, MeshState{}, {});
  const MeshState read = read_step(folder / "first.bin", MeshState{}).state;
  CHECK(read.mesh.coordinates == first.mesh.coordinates);
  CHECK(read.mesh.topology->element_count() == first.mesh.topology->element_count());
  CHECK(read.mesh.topology->markers().size() == first.mesh.topology->markers().size());
  CHECK(read.vcv == nullptr);

  MeshState second = first;
  const Index node = first.mesh.topology->interior_nodes().front();
  second.mesh.coordinates.set_xyz(node, first.mesh.coordinates.xyz(node) + Vec3(0.01, 0, 0));
  write_step(folder / "second.bin", second, first, {});
  const MeshState next = read_step(folder / "second.bin", first).state;
  CHECK(next.mesh.coordinates == second.mesh.coordinates);
  CHECK(next.mesh.topology == first.mesh.topology);
}

}  // namespace winslow::gui::test
