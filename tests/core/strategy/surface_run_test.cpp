#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/command/command.h"
#include "core/error.h"
#include "core/problem/node_unknowns.h"
#include "core/quality/quality.h"
#include "support/surface_meshes.h"

/// Smoothing of surface meshes whose shape is known by a formula.
namespace winslow::test {
namespace {

/// Every inner node somewhere within `reach` edges along the surface.
MeshState scrambled(const MeshState& state, double reach, Random& random) {
  const NodeUnknowns nodes(classes_on(state), 1);
  std::vector<double> u(nodes.unknowns());
  nodes.lengths(state.mesh.coordinates, u);
  for (double& value : u) value *= reach * random.uniform(-1, 1);
  MeshState out = state;
  nodes.advance(u, 1, out.mesh.coordinates);
  return out;
}

Index flips(const MeshState& state) {
  return check_validity(*state.mesh.topology, state.mesh.coordinates, 1,
                        reference_normals(state, state.mesh.coordinates))
      .inverted;
}

double off_shape(const MeshState& state, const Shape& shape) {
  double largest = 0;
  for (Index i = 0; i < state.mesh.coordinates.size(); ++i) {
    const Vec3 p = state.mesh.coordinates.xyz(i);
    largest = std::max(largest, (p - shape(p).point).norm());
  }
  return largest;
}

void check_smoothed(const MeshState& state, const Shape& shape, double least, double mean) {
  const CommandResult result = execute(SmoothCommand{}, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(flips(result.state) == 0);
  CHECK(off_shape(result.state, shape) < 1e-12);
  const Mesh& mesh = result.state.mesh;
  const auto sines = measure_quality(mesh).of(Metric::normalized_jacobian).statistics;
  CHECK(sines.min >= least);
  CHECK(sines.avg >= mean);
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    if (mesh.topology->on_boundary(i))
      CHECK(mesh.coordinates.same_place(i, state.mesh.coordinates));
}

}  // namespace

TEST_CASE("surfaces: smoothing a plane mesh in space is smoothing in the plane") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Random random(2);
    MeshData data = square_with_hole(15, cells);
    Mesh plane = make_mesh(data);
    perturb(plane, random, 0.4);
    data.coordinates = plane.coordinates;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Vec3(2, -1, 1).normalized()).toRotationMatrix();
    const Vec3 shift(1, 2, 3);
    const auto embed = [&](const Vec2& p) -> Vec3 { return turn * Vec3(p.x(), p.y(), 0) + shift; };
    const Mesh mesh = make_mesh(lifted(data, embed));
    SmoothCommand command;
    command.smooth.tolerance = 1e-11;
    const auto flat = execute(command, make_state(plane));
    const auto result = execute(command, on_shape(mesh, plane_shape(shift, turn.col(2))));
    CHECK(result.smooth.converged);
    double largest = 0, moved = 0;
    for (Index i = 0; i < plane.coordinates.size(); ++i) {
      const Vec3 expected = embed(flat.state.mesh.coordinates.xy(i));
      largest = std::max(largest, (result.state.mesh.coordinates.xyz(i) - expected).norm());
      moved = std::max(moved, (mesh.coordinates.xyz(i) - expected).norm());
    }
    CHECK(moved > 0.002);
    CHECK(largest < 1e-10);
  }
}

TEST_CASE("surfaces: scrambled on a sphere, a torus, a cylinder, they come out good") {
  Random random(3);
  {
    const Shape sphere = sphere_shape(1);
    const MeshState state = on_shape(make_mesh(octasphere(8)), sphere);
    const MeshState start = scrambled(state, 1.5, random);
    CHECK(flips(start) > 50);
    check_smoothed(start, sphere, 0.35, 0.84);
  }
  {
    const Shape torus = torus_shape(2, 0.8);
    const auto ring = [](const Vec2& p) { return on_torus(p, 2, 0.8); };
    const MeshState state = on_shape(make_mesh(torus_grid(40, 20, Cells::triangles, ring)), torus);
    const MeshState start = scrambled(state, 1.5, random);
    CHECK(flips(start) > 50);
    check_smoothed(start, torus, 0.35, 0.84);
  }
  {
    const Shape cylinder = cylinder_shape(1);
    const auto roll = [](const Vec2& p) -> Vec3 {
      return {std::cos(2 * p.x()), std::sin(2 * p.x()), 2 * p.y()};
    };
    const MeshState state = on_shape(make_mesh(lifted(square(12, Cells::quads), roll)), cylinder);
    const MeshState start = scrambled(state, 1.5, random);
    CHECK(flips(start) > 20);
    check_smoothed(start, cylinder, 0.9, 0.99);
  }
}

TEST_CASE("surfaces: VCVs are those of the tangent planes") {
  const Shape sphere = sphere_shape(1);
  Random random(8);
  const MeshState start = scrambled(on_shape(make_mesh(octasphere(6)), sphere), 0.3, random);
  SmoothCommand command;
  command.smooth.targets = TargetBlend{0, 0, 1, 0};
  const CommandResult result = execute(command, start);
  CHECK(result.smooth.converged);
  CHECK(flips(result.state) == 0);
  // One that is edited draws its neighbours after it.
  EditVcvCommand edit;
  const Index node = 40;
  const auto count = start.mesh.topology->neighbours(node).size();
  VcvEdit wide;
  wide.node = node;
  wide.lengths.assign(count, 1.0);
  wide.lengths[0] = 3;
  edit.edits = {wide};
  const CommandResult edited = execute(edit, result.state);
  CHECK(edited.smooth.converged);
  const auto length = [&](const MeshState& state) {
    const Coordinates& x = state.mesh.coordinates;
    return (x.xyz(start.mesh.topology->neighbours(node)[0]) - x.xyz(node)).norm();
  };
  CHECK(length(edited.state) > 1.1 * length(result.state));
}

TEST_CASE("surfaces: results do not depend on the number of threads") {
  const Shape torus = torus_shape(2, 0.8);
  const auto ring = [](const Vec2& p) { return on_torus(p, 2, 0.8); };
  Random random(9);
  const MeshState start = scrambled(
      on_shape(make_mesh(torus_grid(90, 60, Cells::triangles, ring)), torus), 0.2, random);
  SmoothCommand one, two;
  one.smooth.threads = 1;
  two.smooth.threads = 2;
  CHECK(execute(one, start).state.mesh.coordinates == execute(two, start).state.mesh.coordinates);
}

}  // namespace winslow::test
