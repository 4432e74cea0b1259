#include "core/mesh/local_frame.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

namespace winslow::test {

namespace {

Mesh shifted(MeshData data, const Vec2& by) {
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + by);
  return make_mesh(data);
}

}  // namespace

TEST_CASE("a mesh near the origin is its own frame") {
  for (const Vec2& by : {Vec2(0, 0), Vec2(-0.5, -0.5), Vec2(15, -12)}) {
    const LocalFrame frame(shifted(square(4, Cells::quads), by));
    CHECK_FALSE(frame.shifts());
    CHECK(frame.origin() == Vec3(0, 0, 0));
  }
}

TEST_CASE("far from the origin nodes go to the frame exactly and come back bit by bit") {
  for (const Vec2& by : {Vec2(1e7, -3e7), Vec2(-20, 17), Vec2(123456.789, 0.25), Vec2(0, 1e15)}) {
    MeshData data = square(8, Cells::triangles);
    if (by.norm() > 1e14)
      for (double& value : data.coordinates.values()) value *= 1024;  // apart at that distance
    const Mesh mesh = shifted(data, by);
    const LocalFrame frame(mesh);
    REQUIRE(frame.shifts());
    CHECK(bounds(frame.to_local(mesh)).max.cwiseAbs().maxCoeff() < 16.1 * 1024);
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      const Vec2 p = mesh.coordinates.xy(i);
      CHECK(frame.to_mesh(frame.to_local(p)) == p);
    }
    CHECK(frame.to_mesh(frame.to_local(mesh.coordinates), mesh.coordinates) == mesh.coordinates);
  }
}

TEST_CASE("axes along which a mesh is near 0 are left alone") {
  const LocalFrame frame(shifted(square(4, Cells::quads), Vec2(1e7, 0.1)));
  CHECK(frame.origin().x() == 1e7 + 0.5);
  CHECK(frame.origin().y() == 0);
}

TEST_CASE("nodes of no element come back bit by bit, wherever they are") {
  MeshData data = square(4, Cells::quads);
  for (double& value : data.coordinates.values()) value += 1e7;
  data.coordinates.push_xy(Vec2(0.1, 1e-30));
  const Mesh mesh = make_mesh(data);
  const LocalFrame frame(mesh);
  REQUIRE(frame.shifts());
  Coordinates x = frame.to_local(mesh.coordinates);
  x.set_xy(0, x.xy(0) + Vec2(0.5, 0));
  x.push_xy(Vec2(0, 0));  // layers add nodes
  const Coordinates back = frame.to_mesh(x, mesh.coordinates);
  CHECK(back.xy(0) == mesh.coordinates.xy(0) + Vec2(0.5, 0));
  for (Index i = 1; i < mesh.coordinates.size(); ++i) CHECK(back.xy(i) == mesh.coordinates.xy(i));
  CHECK(back.xy(back.size() - 1) == frame.origin().head<2>());
}

TEST_CASE("the frame of a volume mesh has three axes, of which each may be far from 0 alone") {
  for (const Vec3& by :
       {Vec3(4.5e5, 5.1e6, 300), Vec3(0, 0, 1e7), Vec3(0.25, -20, 0), Vec3(-1e6, 0, 0.125)}) {
    CAPTURE(by.transpose());
    MeshData data = cube(3, Volumes::mixed);
    for (Index i = 0; i < data.node_count(); ++i)
      data.coordinates.set_xyz(i, data.coordinates.xyz(i) + by);
    const Mesh mesh = make_mesh(data);
    const LocalFrame frame(mesh);
    REQUIRE(frame.shifts());
    for (const int axis : {0, 1, 2}) {
      const double middle = space_bounds(mesh).centre()[axis];
      CHECK(frame.origin()[axis] == (std::abs(by[axis]) > 16 ? middle : 0));
    }
    const Coordinates local = frame.to_local(mesh.coordinates);
    for (Index i = 0; i < local.size(); ++i) {
      const Vec3 p = mesh.coordinates.xyz(i);
      CHECK(local.xyz(i) == p - frame.origin());
      CHECK(frame.to_mesh(frame.to_local(p)) == p);
    }
    CHECK(frame.to_mesh(local, mesh.coordinates) == mesh.coordinates);
  }
  CHECK_FALSE(LocalFrame(make_mesh(cube(3, Volumes::mixed))).shifts());
}

}  // namespace winslow::test
