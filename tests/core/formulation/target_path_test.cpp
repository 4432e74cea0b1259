#include "core/formulation/target_path.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"

#include <doctest/doctest.h>

#include <memory>

#include "core/mesh/mesh.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("a mesh is the minimum for its own shapes, and the path from there ends at the targets") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = make_mesh(square(8, cells));
    Random random(11);
    for (const Index node : mesh.topology->interior_nodes()) {
      const Vec2 move(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03));
      mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + move);
    }
    const VirtualControlVolumes vcv(mesh.topology);
    const auto wanted = std::make_shared<const VariationalWinslow>(
        free_interior(mesh.topology), TargetShapes::build(vcv, {0, 0.5, 0.5, 0}, nullptr, 1),
        PenaltyOptions{}, 1);
    const ShapePath<2> path(wanted, PlanePoints(mesh.coordinates), 1);
    CHECK(path.form_at(0)->residual(mesh.coordinates, {}).max < 1e-10);
    CHECK(path.form_at(0)->worst_distortion(mesh.coordinates) == doctest::Approx(1));
    CHECK(path.form_at(1) == wanted);
    double last = 1;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      const double worst = path.form_at(share)->worst_distortion(mesh.coordinates);
      CHECK(worst > last);
      last = worst;
    }
    // Half of the way lies halfway between the metrics.
    const ShapeTerm own = path.form_at(0)->shapes().terms[5];
    const ShapeTerm half = path.form_at(0.5)->shapes().terms[5];
    const ShapeTerm end = wanted->shapes().terms[5];
    const double whole = stretch_between(TargetMetric::of(own), TargetMetric::of(end));
    CHECK(stretch_between(TargetMetric::of(own), TargetMetric::of(half)) ==
          doctest::Approx(0.5 * whole).epsilon(1e-5));
    CHECK(stretch_between(TargetMetric::of(half), TargetMetric::of(end)) ==
          doctest::Approx(0.5 * whole).epsilon(1e-5));
  }
}
