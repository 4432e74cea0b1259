#include "core/strategy/smooth_run.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A motion of any nodes by one displacement.
class Shift final : public Motion {
 public:
  Shift(std::vector<Index> nodes, const Vec2& by) : nodes_(std::move(nodes)), by_(by) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (const Index node : nodes_) out.set_xy(node, rest.xy(node) + fraction * by_);
  }

 private:
  std::vector<Index> nodes_;
  Vec2 by_;
};

struct Way {
  const char* formulation;
  OuterMethod outer;
};

}  // namespace

TEST_CASE("a motion may take interior nodes: they go where it says and the others make room") {
  for (const Way& way :
       {Way{"variational", OuterMethod::newton}, Way{"pointwise", OuterMethod::newton},
        Way{"pointwise", OuterMethod::picard}}) {
    CAPTURE(way.formulation);
    const MeshState state = make_state(make_mesh(square(12, Cells::triangles)));
    const Topology& topology = *state.mesh.topology;
    SmoothOptions options;
    options.formulation = way.formulation;
    options.outer = way.outer;
    options.threads = 1;
    Coordinates rest = state.mesh.coordinates;
    REQUIRE(smooth_interior(state, options, rest, {}).converged);

    // The node nearest to the middle and those around it.
    Index middle = topology.interior_nodes()[0];
    for (const Index node : topology.interior_nodes()) {
      const Vec2 centre(0.5, 0.5);
      if ((rest.xy(node) - centre).norm() < (rest.xy(middle) - centre).norm()) middle = node;
    }
    std::vector<Index> patch(topology.neighbours(middle).begin(),
                             topology.neighbours(middle).end());
    patch.push_back(middle);
    const Vec2 by(0.05, -0.03);
    const Shift motion(patch, by);

    MeshState smooth = state;
    smooth.mesh.coordinates = rest;
    Coordinates x = rest;
    const SmoothResult result = smooth_motion(smooth, motion, {}, options, x, {});
    CHECK(result.converged);
    CHECK(result.fraction_reached == 1);
    CHECK(check_validity(topology, x).inverted == 0);
    for (const Index node : patch) CHECK(x.xy(node) == rest.xy(node) + by);
    Index followed = 0;
    for (const Index node : topology.interior_nodes()) {
      if (x.xy(node) != rest.xy(node)) ++followed;
    }
    CHECK(followed == static_cast<Index>(topology.interior_nodes().size()));

    // With nothing prescribed the mesh springs back: the patch was held, not smoothed.
    Coordinates back = x;
    REQUIRE(smooth_interior(smooth, options, back, {}).converged);
    CHECK((back.xy(middle) - rest.xy(middle)).norm() < 1e-6);
  }
}
