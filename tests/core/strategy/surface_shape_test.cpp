#include "core/strategy/surface_shape.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/error.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

std::vector<Index> held(const Mesh& mesh, bool border_slides = false) {
  std::vector<bool> slides;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    slides.push_back(border_slides || !mesh.topology->on_boundary(i));
  return nodes_to_hold(*mesh.topology, mesh.coordinates, slides);
}

Vec3 ring(const Vec2& p) { return on_torus(p, 2, 0.8); }
Vec3 bowl(const Vec2& p) { return {p.x(), p.y(), p.squaredNorm()}; }

}  // namespace

TEST_CASE("surface shape: as many nodes are held as a mesh could move by for nothing") {
  const Mesh sphere = make_mesh(octasphere(6));
  const auto three = held(sphere);
  REQUIRE(three.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK((sphere.coordinates.xyz(three[i]) - sphere.coordinates.xyz(three[(i + 1) % 3])).norm() >
          1);
  CHECK(held(make_mesh(torus_grid(20, 10, Cells::mixed, ring))).size() == 1);
  // A border that stays holds as well, one that slides does not.
  const Mesh open = make_mesh(lifted(square(6, Cells::mixed), bowl));
  CHECK(held(open).empty());
  CHECK(held(open, true).size() == 3);
  // A small hole holds what lies near.
  MeshData data = octasphere(12);
  data.types.pop_back();
  data.element_offsets.pop_back();
  data.element_nodes.resize(data.element_nodes.size() - 3);
  CHECK(held(make_mesh(data)).size() == 2);
  // Each part by itself.
  MeshData two = octasphere(3);
  const Index count = two.node_count();
  const MeshData other = octasphere(4);
  for (Index i = 0; i < other.node_count(); ++i)
    two.coordinates.push_xyz(other.coordinates.xyz(i) + Vec3(5, 0, 0));
  for (Index e = 0; e < other.element_count(); ++e) {
    const auto nodes = other.element(e);
    add_triangle(two, nodes[0] + count, nodes[1] + count, nodes[2] + count);
  }
  CHECK(held(make_mesh(two)).size() == 6);
}

TEST_CASE("surface shape: that of the mesh as given, whatever is done to it since") {
  const MeshState state = make_state(make_mesh(octasphere(8)));
  ScrambleCommand scramble;
  scramble.seed = 3;
  const CommandResult tangled = execute(scramble, state);
  REQUIRE(tangled.state.surface);
  CHECK(tangled.smooth.inverted > 100);
  const CommandResult smooth = execute(SmoothCommand{}, tangled.state);
  CHECK(smooth.state.surface == tangled.state.surface);
  CHECK(smooth.smooth.inverted == 0);
  REQUIRE(smooth.smooth.boundary.sliding.size() == 1);
  CHECK(smooth.smooth.boundary.sliding[0].description == "sphere of radius 1");
  // Other features are found in the same mesh as given.
  SmoothCommand sharp;
  sharp.smooth.slide.feature_angle = 60;
  const CommandResult again = execute(sharp, tangled.state);
  CHECK(again.state.surface != tangled.state.surface);
  CHECK(again.state.surface->given == state.mesh.coordinates);
  CHECK(again.smooth.inverted == 0);
  // Nodes that stay have their bits.
  Index moved = 0;
  for (Index i = 0; i < state.mesh.coordinates.size(); ++i)
    moved += tangled.state.mesh.coordinates.same_place(i, smooth.state.mesh.coordinates) ? 0 : 1;
  CHECK(moved == state.mesh.coordinates.size() - 3);
  SmoothCommand sliding;
  sliding.smooth.slide.markers = {"surface"};
  CHECK_THROWS_AS(execute(sliding, state), UsageError);
}

}  // namespace winslow::test
