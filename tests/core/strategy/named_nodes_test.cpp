#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/command/command.h"
#include "core/error.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

/// Single nodes that are told what to do: hold_nodes and smooth_nodes.
namespace winslow::test {
namespace {

bool same_bits(const Coordinates& a, const Coordinates& b, Index node) {
  const auto n = static_cast<std::size_t>(a.dimension());
  return std::ranges::equal(a.values().subspan(at(node) * n, n),
                            b.values().subspan(at(node) * n, n));
}

double way(const Coordinates& a, const Coordinates& b, Index node) {
  double sum = 0;
  const auto n = static_cast<std::size_t>(a.dimension());
  for (std::size_t k = 0; k < n; ++k) {
    const double d = a.values()[at(node) * n + k] - b.values()[at(node) * n + k];
    sum += d * d;
  }
  return std::sqrt(sum);
}

Index node_at(const Mesh& mesh, const Vec2& p) {
  Index best = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    if ((mesh.coordinates.xy(i) - p).norm() < (mesh.coordinates.xy(best) - p).norm()) best = i;
  return best;
}

/// Nodes of an outer circle of 24 at uneven angles, so that all of them would like to move.
constexpr Index sectors = 24, rings = 5;
constexpr double growth = 1.25;
Mesh uneven_annulus() {
  Mesh mesh = make_mesh(annulus(sectors, rings, growth, Cells::triangles));
  Random random(21);
  const double radius = std::pow(growth, rings);
  for (Index j = 0; j < sectors; ++j) {
    const Index node = rings * sectors + j;
    const Vec2 p = mesh.coordinates.xy(node);
    const double phi = std::atan2(p.y(), p.x()) + 0.08 * random.uniform(-1, 1);
    mesh.coordinates.set_xy(node, radius * Vec2(std::cos(phi), std::sin(phi)));
  }
  return mesh;
}
std::vector<Index> some_of_the_rim() {
  std::vector<Index> nodes;
  for (Index j = 4; j < 11; ++j) nodes.push_back(rings * sectors + j);
  return nodes;
}

}  // namespace

TEST_CASE("a held node does not move by a bit, on a side that slides and inside") {
  Mesh mesh = make_mesh(square(8, Cells::triangles));
  Random random(3);
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    Vec2 p = mesh.coordinates.xy(node);
    if (p.y() == 0 && p.x() > 1e-9 && p.x() < 1 - 1e-9)
      mesh.coordinates.set_xy(node, p + Vec2(0.04 * random.uniform(-1, 1), 0));
  }
  perturb(mesh, random, 0.3);
  const Index on_side = node_at(mesh, {0.5, 0}), inside = node_at(mesh, {0.5, 0.5});
  REQUIRE_FALSE(mesh.topology->on_boundary(inside));
  SmoothCommand command;
  command.smooth.slide.markers = {"bottom"};
  const CommandResult free = execute(command, make_state(mesh));
  CHECK(way(free.state.mesh.coordinates, mesh.coordinates, on_side) > 1e-3);
  CHECK(way(free.state.mesh.coordinates, mesh.coordinates, inside) > 1e-3);
  command.smooth.slide.hold_nodes = {inside, on_side};
  const CommandResult held = execute(command, make_state(mesh));
  CHECK(held.smooth.converged);
  CHECK(held.smooth.kept_outside == 0);
  CHECK(held.smooth.boundary.held == 2);
  CHECK(same_bits(held.state.mesh.coordinates, mesh.coordinates, on_side));
  CHECK(same_bits(held.state.mesh.coordinates, mesh.coordinates, inside));
  REQUIRE(held.smooth.boundary.sliding.size() == 1);
  CHECK(held.smooth.boundary.sliding[0].nodes.size() == 6);  // of seven
  for (const Index node : held.smooth.boundary.sliding[0].nodes)
    CHECK(way(held.state.mesh.coordinates, mesh.coordinates, node) > 0);

  // With the pointwise form, which knows no sliding, too.
  command.smooth = {};
  command.smooth.formulation = Formulation::pointwise;
  command.smooth.slide.hold_nodes = {inside};
  const CommandResult pointwise = execute(command, make_state(mesh));
  CHECK(pointwise.smooth.converged);
  CHECK(same_bits(pointwise.state.mesh.coordinates, mesh.coordinates, inside));
}

TEST_CASE("former corners slide on the curve through them, here a circle") {
  const Mesh mesh = uneven_annulus();
  const double radius = std::pow(growth, rings);
  SmoothCommand command;
  command.smooth.slide.markers = {"outer"};
  command.smooth.slide.feature_angle = 5;  // by which every node of the circle turns
  CHECK_THROWS_WITH_AS(execute(command, make_state(mesh)), doctest::Contains("no node"),
                       UsageError);
  const std::vector<Index> smooth = some_of_the_rim();
  command.smooth.slide.smooth_nodes = smooth;
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  const Coordinates& x = result.state.mesh.coordinates;
  for (Index j = 0; j < sectors; ++j) {
    const Index node = rings * sectors + j;
    CAPTURE(node);
    if (std::ranges::find(smooth, node) == smooth.end()) {
      CHECK(same_bits(x, mesh.coordinates, node));
      continue;
    }
    CHECK(way(x, mesh.coordinates, node) > 1e-4);
    CHECK(std::abs(x.xy(node).norm() - radius) < 1e-12);
  }
  // One of them held after all.
  command.smooth.slide.hold_nodes = {smooth[2]};
  const CommandResult held = execute(command, make_state(mesh));
  CHECK(same_bits(held.state.mesh.coordinates, mesh.coordinates, smooth[2]));
  CHECK(way(held.state.mesh.coordinates, mesh.coordinates, smooth[3]) > 1e-4);
}

TEST_CASE("surface meshes: a held node stays, corners of the border slide on its circle") {
  // A shallow bowl: by the angle every node of its border turns, and nothing else.
  const Mesh plane = uneven_annulus();
  MeshData data = lifted(annulus(sectors, rings, growth, Cells::triangles),
                         [](const Vec2& p) { return Vec3(p.x(), p.y(), 0.01 * p.squaredNorm()); });
  for (Index i = 0; i < plane.coordinates.size(); ++i) {
    const Vec2 p = plane.coordinates.xy(i);
    data.coordinates.set_xyz(i, {p.x(), p.y(), 0.01 * p.squaredNorm()});
  }
  const Mesh mesh = make_mesh(data);
  const double radius = std::pow(growth, rings);
  SmoothCommand command;
  command.smooth.slide.feature_angle = 8;
  command.smooth.slide.features = true;
  const CommandResult before = execute(command, make_state(mesh));
  const std::vector<Index> smooth = some_of_the_rim();
  for (const Index node : smooth)
    CHECK(same_bits(before.state.mesh.coordinates, mesh.coordinates, node));
  const Index inside = 2 * sectors + 3;
  CHECK(way(before.state.mesh.coordinates, mesh.coordinates, inside) > 1e-5);
  command.smooth.slide.smooth_nodes = smooth;
  command.smooth.slide.hold_nodes = {inside};
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.boundary.held == 1);
  const Coordinates& x = result.state.mesh.coordinates;
  CHECK(same_bits(x, mesh.coordinates, inside));
  for (const Index node : smooth) {
    CHECK(way(x, mesh.coordinates, node) > 1e-4);
    CHECK(std::abs(x.xyz(node).head<2>().norm() - radius) < 1e-9);
    CHECK(std::abs(x.xyz(node).z() - 0.01 * radius * radius) < 1e-9);
  }
  command.smooth.slide.features = false;
  CHECK_THROWS_WITH_AS(execute(command, make_state(mesh)),
                       doctest::Contains("lies on a feature line"), UsageError);
}

TEST_CASE("volume meshes: a held node of a face stays while a body draws the others along") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  MoveCommand move;
  std::vector<std::string> walls;
  for (const Marker& marker : mesh.topology->markers())
    (marker.name == "cavity" ? move.bodies[0].markers : walls).push_back(marker.name);
  REQUIRE(move.bodies[0].markers.size() == 1);
  move.bodies[0].motion.rotate = 20;
  move.bodies[0].motion.axis = Vec3(0, 0, 1);
  move.smooth.slide.markers = walls;
  const CommandResult free = execute(move, make_state(mesh));
  Index farthest = -1;
  for (const SlidingPart& part : free.smooth.boundary.sliding)
    for (const Index node : part.nodes)
      if (farthest < 0 || way(free.state.mesh.coordinates, mesh.coordinates, node) >
                              way(free.state.mesh.coordinates, mesh.coordinates, farthest))
        farthest = node;
  CHECK(way(free.state.mesh.coordinates, mesh.coordinates, farthest) > 1e-3);
  move.smooth.slide.hold_nodes = {farthest};
  const CommandResult held = execute(move, make_state(mesh));
  CHECK(held.smooth.converged);
  CHECK(same_bits(held.state.mesh.coordinates, mesh.coordinates, farthest));
  // The surface first, then the interior: it stays in both.
  SmoothCommand smooth;
  smooth.smooth.slide = move.smooth.slide;
  smooth.smooth.slide.surface_first = true;
  const CommandResult first = execute(smooth, make_state(held.state.mesh));
  CHECK(same_bits(first.state.mesh.coordinates, mesh.coordinates, farthest));
}

TEST_CASE("nodes that the mesh has not, or that cannot do it, are refused by name") {
  const MeshState state = make_state(make_mesh(square(4, Cells::quads)));
  const auto fault = [&](const SlideOptions& slide, const MeshState& of) {
    SmoothCommand command;
    command.smooth.slide = slide;
    try {
      execute(command, of);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  SlideOptions slide;
  slide.hold_nodes = {25};
  CHECK(fault(slide, state) == "there is no node 25: the mesh has 25");
  slide.markers = {"bottom"};
  CHECK(fault(slide, state) == "found node 25 to hold or to make smooth, expected 0 to 24");
  slide.hold_nodes = {-1};
  CHECK(fault(slide, state).find("slide.hold_nodes: found -1, expected 0 or more") == 0);
  slide.hold_nodes.clear();
  const Index corner = node_at(state.mesh, {0, 0}), top = node_at(state.mesh, {0.5, 1});
  slide.smooth_nodes = {corner};
  CHECK(fault(slide, state) ==
        "node " + std::to_string(corner) +
            " cannot be smooth: marker \"bottom\" ends or branches there, or meets another marker");
  slide.smooth_nodes = {top};
  CHECK(fault(slide, state) ==
        "node " + std::to_string(top) + " cannot be smooth: no marker that slides has it");
  slide.markers.clear();
  CHECK(fault(slide, state).find("smooth_nodes: no marker slides") == 0);

  SlideOptions periodic;
  const MeshState sides = make_state(make_mesh(square_with_periodic_sides(10)));
  periodic.periodic = {"left", "right"};
  const auto m = *sides.mesh.topology->markers().find("left");
  periodic.hold_nodes = {sides.mesh.topology->markers().nodes(m)[3]};
  CHECK(fault(periodic, sides).find("moves with one of the periodic pair left, right") !=
        std::string::npos);

  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.rotate = 5;
  const auto hole = *sides.mesh.topology->markers().find("hole");
  move.smooth.slide.hold_nodes = {sides.mesh.topology->markers().nodes(hole)[0]};
  CHECK_THROWS_WITH_AS(execute(move, sides), doctest::Contains("the motion takes it"), UsageError);

  const Mesh box = make_mesh(cube(4, Volumes::tetrahedra));
  SlideOptions space;
  space.markers = {"walls", "lid"};
  space.features = true;
  for (Index i = 0; i < box.coordinates.size(); ++i) {
    const Vec3 p = box.coordinates.xyz(i);
    const std::string node = "node " + std::to_string(i) + " cannot be smooth: ";
    space.smooth_nodes = {i};
    if (p == Vec3(0, 0, 1))
      CHECK(fault(space, make_state(box)) == node + "feature lines end or meet there");
    if (p == Vec3(0, 0, 0))
      CHECK(fault(space, make_state(box)) == node + "it meets the boundary that does not slide");
    if (p == Vec3(0.5, 0.5, 0.5))
      CHECK(fault(space, make_state(box)) == node + "it is no node of what slides");
  }
}

}  // namespace winslow::test
