#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/inspect/nodal_view.h"
#include "core/mesh/surface_faces.h"
#include "core/vcv/vcv_edit.h"
#include "support/surface_meshes.h"

/// VCVs of surface meshes given to other nodes, and where they are drawn.
namespace winslow::test {

TEST_CASE("on a plane put anywhere into space VCVs are spread as in the plane") {
  const MeshData flat = square(8, Cells::triangles);
  const Mesh plane = make_mesh(flat);
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized())).toRotationMatrix();
  const Mesh surface = make_mesh(lifted(
      flat, [&](const Vec2& p) { return Vec3(turn * Vec3(p.x(), p.y(), 0) + Vec3(3, 1, 2)); }));
  REQUIRE(is_surface(*surface.topology));
  const MeshState a = make_state(plane), b = make_state(surface);
  std::vector<Index> six;
  for (const Index node : plane.topology->interior_nodes())
    if (plane.topology->neighbours(node).size() == 6) six.push_back(node);
  REQUIRE(six.size() > 10);
  const Index source = six.front();
  VcvEdit edit = edit_of(*a.vcvs.plane(), source);
  edit.angles = {40, 80, 60, 60, 50, 70};
  const auto in_plane = edit_vcvs(*a.vcvs.plane(), std::span(&edit, 1));
  const auto in_space = edit_vcvs(*b.vcvs.plane(), std::span(&edit, 1));
  const std::vector<Index> targets(six.begin() + 1, six.end());
  const auto first = spread_vcv(*in_plane, plane.coordinates, source, targets);
  const auto second = spread_vcv(*in_space, surface.coordinates, source, targets);
  REQUIRE(first.size() == second.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    CHECK(first[k].neighbours == second[k].neighbours);
    CHECK(first[k].angles == second[k].angles);
  }
}

TEST_CASE("on a cylinder edges that run along its axis keep their numbers all the way round") {
  // Rings of quadrilaterals: node (i, j) has neighbours along the axis and around it.
  constexpr Index round = 16, along = 5;
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index j = 0; j <= along; ++j)
    for (Index i = 0; i < round; ++i) {
      const double phi = 2 * pi * i / round;
      data.coordinates.push_xyz({std::cos(phi), std::sin(phi), 0.4 * j});
    }
  const auto id = [&](Index i, Index j) { return j * round + i % round; };
  for (Index j = 0; j < along; ++j)
    for (Index i = 0; i < round; ++i)
      data.add_element(ElementType::quadrilateral,
                       std::array{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  const Mesh mesh = make_mesh(data);
  const MeshState state = make_state(mesh);
  const Index source = id(0, 2);
  std::vector<Index> targets;
  for (Index i = 1; i < round; ++i)
    if (i != round / 2) targets.push_back(id(i, 3));  // opposite is as far round either way
  const auto ring = mesh.topology->neighbours(source);
  const auto up = std::ranges::find(ring, id(0, 3)) - ring.begin();
  for (const VcvEdit& edit : spread_vcv(*state.vcvs.plane(), mesh.coordinates, source, targets)) {
    CAPTURE(edit.node);
    CHECK(edit.neighbours[static_cast<std::size_t>(up)] == edit.node + round);
  }
}

TEST_CASE("the plane of a star is tangent, and the flat star lies over the one in space") {
  const Mesh mesh = make_mesh(octasphere(6));
  const MeshState state = make_state(mesh);
  const SpacePoints x(mesh.coordinates);
  for (const Index node : mesh.topology->interior_nodes()) {
    const NodalView view = inspect_node(*state.vcvs.plane(), mesh.coordinates, node);
    const StarPlane plane = plane_of_star(*mesh.topology, mesh.coordinates, view);
    CHECK(std::abs(plane.u.dot(plane.v)) < 1e-14);
    CHECK(std::abs(plane.u.norm() - 1) < 1e-14);
    CHECK(plane.u.cross(plane.v).dot(x[node]) > 0.98);  // outwards, as the elements
    for (std::size_t k = 0; k < view.neighbours.size(); ++k) {
      const Vec3 there = plane.point(view.physical.points[k]);
      CHECK((there - x[view.neighbours[k]]).norm() < 0.25 * view.physical.lengths[k]);
    }
  }
}

}  // namespace winslow::test
