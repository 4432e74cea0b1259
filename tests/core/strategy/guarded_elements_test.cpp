#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/strategy/workspace.h"
#include "support/formulations.h"
#include "support/space_meshes.h"

/// Elements whose Jacobian the energy of a run keeps positive between their corners.
namespace winslow::test {
namespace {

std::size_t cells(SmoothingWorkspace& workspace) {
  return static_cast<const VolumeWinslow&>(*workspace.energy()).shapes().cells.size();
}

}  // namespace

TEST_CASE("a guarded element has 24 targets more, until it is dropped or the next run begins") {
  const MeshState state = make_state(make_mesh(cube(3, Volumes::hexahedra)));
  const Mesh& mesh = state.mesh;
  const auto classes = free_interior(mesh.topology);
  SmoothOptions options;
  options.targets = TargetBlend::regular();
  options.threads = 1;
  SmoothingWorkspace workspace;
  const auto prepare = [&] { workspace.prepare(state, classes, options); };
  prepare();
  const std::size_t plain = cells(workspace);
  const std::vector<Index> middle{13}, both{0, 13};
  CHECK(workspace.guard(middle));
  CHECK(!workspace.guard(middle));
  CHECK(cells(workspace) == plain + 24);
  CHECK(workspace.guard(both));
  // A corner of the cube has one node that moves: only the tetrahedra with that node count.
  const std::size_t with_both = cells(workspace);
  CHECK(with_both > plain + 24);
  CHECK(with_both < plain + 48);

  // The upper face of the middle element turned by more than a right angle about its middle.
  Coordinates x = mesh.coordinates;
  const auto element = mesh.topology->element(13);
  for (std::size_t k = 4; k < 8; ++k) {
    const Vec3 p = mesh.coordinates.xyz(element[k]);
    const Vec2 q = p.head<2>() - Vec2(0.5, 0.5);
    const double a = 100 * M_PI / 180;
    x.set_xyz(element[k], {0.5 + std::cos(a) * q.x() - std::sin(a) * q.y(),
                           0.5 + std::sin(a) * q.x() + std::cos(a) * q.y(), p.z()});
  }
  CHECK(!workspace.drop_guards_broken_at(mesh.coordinates));
  CHECK(cells(workspace) == with_both);
  CHECK(workspace.drop_guards_broken_at(x));
  CHECK(cells(workspace) == plain + with_both - (plain + 24));
  prepare();
  CHECK(cells(workspace) == plain);
}

}  // namespace winslow::test
