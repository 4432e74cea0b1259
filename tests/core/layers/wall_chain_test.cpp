#include "core/layers/wall_chain.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/error.h"
#include "core/layers/layer_insertion.h"
#include "core/layers/layer_plan.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// One row of quadrilaterals: nodes 0 to 4 below, 5 to 9 above. The inlet and the outlet are one
/// edge each.
MeshData channel() {
  MeshData data;
  for (const double y : {0.0, 1.0})
    for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0}) data.coordinates.push_xy({x, y});
  for (Index i = 0; i < 4; ++i) add_quad(data, i, i + 1, i + 6, i + 5);
  data.markers = {{"bottom", 1, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}},
                  {"outlet", 2, {{4, 9}}},
                  {"top", 3, {{9, 8}, {8, 7}, {7, 6}, {6, 5}}},
                  {"inlet", 4, {{5, 0}}}};
  return data;
}

LayerWall wall_at(const std::vector<std::string>& markers) {
  return {markers, {2, 0.01, 1.2, 1.0, {}, false}};
}

std::vector<WallChain> chains_of(const MeshData& data, const std::vector<LayerWall>& walls) {
  return find_wall_chains(make_mesh(data), walls);
}

}  // namespace

TEST_CASE("a wall is walked with the elements on its left, whichever way its edges are given") {
  MeshData data = channel();
  for (const bool reversed : {false, true}) {
    if (reversed) data.markers[2].faces = {{5, 6}, {7, 6}, {8, 7}, {8, 9}};
    const auto chains = chains_of(data, {wall_at({"top"})});
    REQUIRE(chains.size() == 1);
    CHECK_FALSE(chains[0].closed);
    CHECK(chains[0].nodes == std::vector<Index>{9, 8, 7, 6, 5});
    CHECK(chains[0].wall == std::vector<Index>{0, 0, 0, 0});
    CHECK(chains[0].before == 4);
    CHECK(chains[0].after == 0);
  }
}

TEST_CASE("walls that follow one another make up one chain, others chains of their own") {
  auto chains = chains_of(channel(), {wall_at({"top"}), wall_at({"inlet", "bottom"})});
  REQUIRE(chains.size() == 1);
  CHECK(chains[0].nodes == std::vector<Index>{9, 8, 7, 6, 5, 0, 1, 2, 3, 4});
  CHECK(chains[0].wall == std::vector<Index>{0, 0, 0, 0, 1, 1, 1, 1, 1});
  CHECK(chains[0].before == 4);
  CHECK(chains[0].after == 9);

  chains = chains_of(channel(), {wall_at({"top"}), wall_at({"bottom"})});
  REQUIRE(chains.size() == 2);
  CHECK(chains[0].nodes == std::vector<Index>{0, 1, 2, 3, 4});
  CHECK(chains[0].before == 5);
  CHECK(chains[0].after == 9);
  CHECK(chains[1].nodes == std::vector<Index>{9, 8, 7, 6, 5});
}

TEST_CASE("a wall all around is a closed chain from its lowest node on") {
  const auto chains = chains_of(channel(), {wall_at({"outlet", "top", "inlet", "bottom"})});
  REQUIRE(chains.size() == 1);
  CHECK(chains[0].closed);
  CHECK(chains[0].nodes == std::vector<Index>{0, 1, 2, 3, 4, 9, 8, 7, 6, 5});
  CHECK(chains[0].edge_count() == 10);
}

TEST_CASE("an edge that two walls ask for, or that lies inside, is no wall") {
  CHECK_THROWS_WITH_AS(chains_of(channel(), {wall_at({"top"}), wall_at({"top"})}),
                       "the layers of marker 'top' are asked for twice", UsageError);
  MeshData data = channel();
  data.markers.push_back({"membrane", 5, {{3, 8}, {2, 7}}});
  CHECK_THROWS_WITH_AS(chains_of(data, {wall_at({"membrane", "top"})}),
                       "the edge between nodes 2 and 7 has elements on both sides; layers are "
                       "inserted at the boundary only",
                       UsageError);
}

TEST_CASE("a boundary edge between two walls is divided by the columns at both of its ends") {
  const Mesh mesh = make_mesh(channel());
  LayerOptions options;
  options.walls = {wall_at({"top"}), wall_at({"bottom"})};
  const LayerInsertion layers = insert_layers(mesh, plan_layers(mesh, options));
  const Topology& topology = *layers.mesh.topology;
  for (const std::string name : {"inlet", "outlet"}) {
    CAPTURE(name);
    const Marker& marker = topology.markers()[at(*topology.markers().find(name))];
    REQUIRE(marker.faces.size() == 5);
    for (std::size_t k = 1; k < marker.faces.size(); ++k)
      CHECK(marker.faces[k].edge()[0] == marker.faces[k - 1].edge()[1]);
  }
  CHECK(topology.markers().unmarked_faces() == 0);
  CHECK(check_validity(topology, layers.mesh.coordinates).inverted == 0);
}

namespace {

/// By brute force over points of all boundary edges but those at the node.
double sampled_radius(const Mesh& mesh, Index node, const Vec2& inward, double reach) {
  double least = reach;
  const Vec2 p = mesh.coordinates.xy(node);
  for (const auto& edge : mesh.topology->edges()) {
    if (edge.elements[1] >= 0 || edge.nodes[0] == node || edge.nodes[1] == node) continue;
    for (int i = 0; i <= 1000; ++i) {
      const Vec2 a = mesh.coordinates.xy(edge.nodes[0]), b = mesh.coordinates.xy(edge.nodes[1]);
      const Vec2 q = a + (b - a) * (i / 1000.0) - p;
      if (inward.dot(q) > 1e-12) least = std::min(least, q.squaredNorm() / (2 * inward.dot(q)));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("between two rings the largest disc at the inner one reaches the outer one") {
  const Mesh mesh = make_mesh(annulus(48, 6, 1.2, Cells::triangles));
  const double outer = std::pow(1.2, 6);
  const Clearance clearance(*mesh.topology, mesh.coordinates, 10);
  for (const Index node : mesh.topology->markers().nodes(0)) {
    const Vec2 outward = mesh.coordinates.xy(node).normalized();
    CHECK(2 * clearance.radius(node, outward) == doctest::Approx(outer - 1).epsilon(0.01));
  }
}

TEST_CASE("a disc's radius is that of brute force, and never beyond the reach") {
  const Mesh mesh = make_mesh(square_with_two_holes(20, Cells::triangles));
  for (const double reach : {1e-300, 1e-12, 0.02, 0.2, 3.0}) {
    CAPTURE(reach);
    const Clearance clearance(*mesh.topology, mesh.coordinates, reach);
    for (const auto& loop : mesh.topology->boundary_loops()) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 edge = mesh.coordinates.xy(loop[(k + 1) % loop.size()]) -
                          mesh.coordinates.xy(loop[(k + loop.size() - 1) % loop.size()]);
        const Vec2 inward = Vec2(-edge.y(), edge.x()).normalized();
        const double exact = clearance.radius(loop[k], inward);
        const double sampled = sampled_radius(mesh, loop[k], inward, reach);
        CHECK(exact <= sampled * (1 + 1e-9));
        CHECK(exact >= sampled * (1 - 1e-3));
      }
    }
  }
}
