#include <doctest/doctest.h>

#include "core/error.h"
#include "core/vcv/sphere/sphere_edit.h"
#include "gui/document/autosave/step_file.h"
#include "gui/support/meshes.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("VCVs of a volume mesh by hand come back with a step to the bit, and go with the next") {
  const TemporaryFolder folder;
  const MeshState first = make_state(winslow::test::shaken_box(3, 0.1, 3));
  const Topology& topology = *first.mesh.topology;
  const Index node = topology.interior_nodes().front();
  SphereStencil stencil = make_node_vcv(topology, first.mesh.coordinates, node, {}).stencil;
  stencil.lengths[1] = 0.1 + 0.2;
  const VcvEdit edit = edit_of(topology, node, stencil);
  MeshState second = first;
  second.sphere_vcvs = edit_vcvs(topology, nullptr, std::span(&edit, 1));
  write_step(folder / "first.bin", first, MeshState{}, {});
  write_step(folder / "second.bin", second, first, {});
  const MeshState read = read_step(folder / "first.bin", MeshState{}).state;
  CHECK(read.sphere_vcvs == nullptr);
  const MeshState edited = read_step(folder / "second.bin", read).state;
  REQUIRE(edited.sphere_vcvs);
  CHECK(*edited.sphere_vcvs == *second.sphere_vcvs);
  // What did not change is that of the state before, and what was reset is gone.
  MeshState third = second;
  write_step(folder / "third.bin", third, second, {});
  CHECK(read_step(folder / "third.bin", edited).state.sphere_vcvs == edited.sphere_vcvs);
  third.sphere_vcvs = nullptr;
  write_step(folder / "fourth.bin", third, second, {});
  CHECK(read_step(folder / "fourth.bin", edited).state.sphere_vcvs == nullptr);
}

}  // namespace winslow::gui::test
