#include "core/strategy/held_walls.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

LayersCommand hold_at(const std::string& marker) {
  LayersCommand hold;
  hold.task = LayerTask::hold;
  hold.layers.walls = {{{marker}, {}}};
  return hold;
}

/// Pushes the lid of a layered cube down, so that the elements under it push against the layers.
MoveCommand push_down(double by) {
  MoveCommand move;
  move.bodies[0].markers = {"lid"};
  move.bodies[0].motion.translate = {0, 0, -by};
  move.smooth.slide.markers = {"walls"};
  move.smooth.slide.features = true;
  move.smooth.tolerance = 1e-10;
  return move;
}

/// The largest |height / given height - 1| over all columns of the first rows over the floor, read
/// from the heights of the nodes alone.
double change_of_heights(const Mesh& mesh, const Coordinates& x, double top) {
  double largest = 0;
  std::map<std::pair<long, long>, std::map<double, Index>> columns;
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const auto i = std::lround(8 * p.x()), j = std::lround(8 * p.y());
    if (i == 0 || j == 0 || i == 8 || j == 8 || p.z() > top) continue;
    columns[{i, j}][p.z()] = node;
  }
  for (const auto& [place, nodes] : columns)
    for (auto lower = nodes.begin(), upper = std::next(lower); upper != nodes.end();
         ++lower, ++upper) {
      const double height = (x.xyz(upper->second) - x.xyz(lower->second)).norm();
      largest = std::max(largest, std::abs(height / (upper->first - lower->first) - 1));
    }
  return largest;
}

}  // namespace

TEST_CASE("Held layers of a volume mesh keep their heights where elements push against them") {
  for (const Volumes volumes : {Volumes::hexahedra, Volumes::prisms, Volumes::tetrahedra}) {
    CAPTURE(std::string(name_of(volumes)));
    const Mesh mesh = layered_cube(volumes);
    const double top = 0.04;  // three rows
    const MoveCommand push = push_down(0.25);
    const CommandResult loose = execute(push, make_state(mesh));
    REQUIRE(loose.smooth.converged);
    CHECK_FALSE(loose.smooth.layers_held);
    const MeshState held = execute(hold_at("floor"), make_state(mesh)).state;
    CHECK(held.mesh.coordinates == mesh.coordinates);
    const CommandResult tight = execute(push, held);
    REQUIRE(tight.smooth.converged);
    CHECK(tight.smooth.inverted == 0);
    REQUIRE(tight.smooth.layers_held);
    CHECK(tight.smooth.layers_held->heights > 0);
    const double with = change_of_heights(mesh, tight.state.mesh.coordinates, top);
    const double without = change_of_heights(mesh, loose.state.mesh.coordinates, top);
    CAPTURE(with);
    CAPTURE(without);
    CHECK(with < 0.5 * without);
    CHECK(with <= tight.smooth.layers_held->error + 1e-12);
  }
}

TEST_CASE("A motion by nothing and one forth and back leave held layers as they were") {
  const Mesh mesh = layered_cube(Volumes::prisms);
  const MeshState held = execute(hold_at("floor"), make_state(mesh)).state;
  CHECK(execute(push_down(0), held).state.mesh.coordinates == mesh.coordinates);
  const MeshState there = execute(push_down(0.2), held).state;
  CHECK(there.held_walls == std::vector<std::string>{"floor"});
  const MeshState back = execute(push_down(-0.2), there).state;
  CHECK(largest_difference(back.mesh.coordinates, mesh.coordinates) < 1e-8);
}

TEST_CASE("Held layers of a volume mesh need targets that know the reference mesh") {
  const MeshState held = execute(hold_at("floor"), make_state(layered_cube(Volumes::prisms))).state;
  MoveCommand push = push_down(0.1);
  push.smooth.targets = TargetBlend::automatically();
  CHECK_THROWS_AS(execute(push, held), UsageError);
}

TEST_CASE("Holding layers leaves the reference mesh as it is") {
  const MeshState moved = execute(push_down(0.1), make_state(layered_cube(Volumes::prisms))).state;
  REQUIRE(moved.reference);
  CHECK(execute(hold_at("floor"), moved).state.reference == moved.reference);
}
