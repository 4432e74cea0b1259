#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/inspect/nodal_view.h"
#include "core/inspect/node_roles.h"
#include "core/strategy/mesh_state.h"
#include "support/surface_meshes.h"
#include "support/vcv.h"

namespace winslow::test {

TEST_CASE("a star of a plane surface, laid flat, is that of the plane") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(2, 1, -2).normalized()).toRotationMatrix();
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    Random random(3);
    const MeshData data = square(6, cells);
    Mesh plane = make_mesh(data);
    perturb(plane, random, 0.3);
    Mesh mesh = make_mesh(lifted(data, [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); }));
    for (Index i = 0; i < plane.coordinates.size(); ++i) {
      const Vec2 p = plane.coordinates.xy(i);
      mesh.coordinates.set_xyz(i, turn * Vec3(p.x(), p.y(), 0) + Vec3(3, 4, 5));
    }
    const VirtualControlVolumes flat(plane.topology), lying(mesh.topology);
    for (const Index node : plane.topology->interior_nodes()) {
      const NodalView a = inspect_node(flat, plane.coordinates, node);
      const NodalView b = inspect_node(lying, mesh.coordinates, node);
      REQUIRE(a.neighbours == b.neighbours);
      CHECK(b.kappa == doctest::Approx(a.kappa));
      CHECK(b.smallest_weight == doctest::Approx(a.smallest_weight));
      CHECK(b.scaled_residual == doctest::Approx(a.scaled_residual));
      for (std::size_t k = 0; k < a.neighbours.size(); ++k) {
        CHECK(b.physical.angles[k] == doctest::Approx(a.physical.angles[k]));
        CHECK(b.physical.lengths[k] == doctest::Approx(a.physical.lengths[k]));
        CHECK(b.weights[k] == doctest::Approx(a.weights[k]));
      }
    }
  }
}

TEST_CASE("the angles of a tip are scaled to 360 degrees, its edges keep their lengths") {
  // Node 4 of an octahedron has four angles of 60 degrees.
  const Mesh mesh = make_mesh(octasphere(1));
  const VirtualControlVolumes vcv(mesh.topology);
  const NodalView view = inspect_node(vcv, mesh.coordinates, 4);
  REQUIRE(view.physical.angles.size() == 4);
  for (const double angle : view.physical.angles) CHECK(degrees(angle) == doctest::Approx(90));
  for (const double length : view.physical.lengths)
    CHECK(length == doctest::Approx(std::sqrt(2.0)));
  CHECK(view.kappa == doctest::Approx(1));
  CHECK(view.scaled_residual == doctest::Approx(0).epsilon(1e-12));
}

TEST_CASE("roles of a surface: inside of faces nodes slide, edges stay or slide, corners stay") {
  // The boundary of a cube of 4 by 4 by 4 cells.
  const Mesh box = make_mesh(skin(cube(4, Volumes::hexahedra)));
  const MeshState state = make_state(box);
  SlideOptions slide;
  const auto count = [](const NodeRoles& roles, NodeRole role) {
    CHECK(roles.counts[static_cast<std::size_t>(role)] == std::ranges::count(roles.roles, role));
    return roles.counts[static_cast<std::size_t>(role)];
  };
  const NodeRoles still = node_roles(state, slide, {});
  CHECK(still.fault.empty());
  CHECK(count(still, NodeRole::on_surface) == 6 * 9);
  CHECK(count(still, NodeRole::corner) == 8 + 12 * 3);
  CHECK(still.features.size() == 12 * 4);
  CHECK(std::ranges::count(still.found, "plane") == 6);
  slide.features = true;
  const NodeRoles roles = node_roles(state, slide, {});
  CHECK(count(roles, NodeRole::on_curve) == 12 * 3);
  CHECK(count(roles, NodeRole::corner) == 8);
  // At 100 degrees nothing is sharp.
  slide.feature_angle = 100;
  const NodeRoles smooth = node_roles(state, slide, {});
  CHECK(smooth.features.empty());
  CHECK(smooth.fault.empty());
}

}  // namespace winslow::test
