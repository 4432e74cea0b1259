#include "core/layers/clearance.h"

#include <doctest/doctest.h>

#include <limits>

#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

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
