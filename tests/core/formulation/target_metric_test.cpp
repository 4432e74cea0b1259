#include "core/formulation/target_metric.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"

namespace winslow::test {

namespace {

/// A corner of three edges that are all long, in a tetrahedron of this height.
Edges3 flat_corner(double height) {
  Edges3 edges;
  edges << 1, 0.3, -0.2, 0.1, 1.2, 0.9, height, -2 * height, 3 * height;
  return edges;
}

}  // namespace

TEST_CASE("metrics of flat tetrahedra keep determinant 1 and their stretch") {
  const Eigen::Matrix3d regular = regular_metrics(ElementType::tetrahedron)[0];
  const double ends = RelativeMetric(regular, volume_metric(flat_corner(1))).stretch();
  double last = ends;
  for (const double height : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    CAPTURE(height);
    const Edges3 edges = flat_corner(height);
    REQUIRE(has_metric(edges));
    const Eigen::Matrix3d metric = volume_metric(edges);
    CHECK((metric.diagonal().array() > 0).all());
    // With the edges as unit vectors it is the identity, scaled as its determinant asks for.
    const Eigen::Matrix3d unit = edges * metric * edges.transpose();
    const double scale = std::pow(edges.determinant(), 2.0 / 3);
    CHECK((unit / scale - Eigen::Matrix3d::Identity()).norm() < 1e-9 / height);
    const RelativeMetric relative(regular, metric);
    CHECK(relative.values.prod() == doctest::Approx(1).epsilon(1e-3));
    // Ten times as flat is ten times as stretched.
    if (height < 0.05)
      CHECK(relative.stretch() - last == doctest::Approx(std::log(10.0)).epsilon(0.02));
    last = relative.stretch();
    CHECK((relative.between(1) - metric).norm() < 1e-6 / height * metric.norm());
    CHECK((relative.between(0) - regular).norm() < 1e-12);
    CHECK((normalized_metric(5 * metric) - metric).norm() < 1e-2 * metric.norm());
    CHECK(relative.between(0.5).allFinite());
  }
  CHECK_FALSE(has_metric(flat_corner(1e-9)));
  CHECK_FALSE(has_metric(flat_corner(-1)));
}

TEST_CASE("tetrahedra thousands of times as long as high keep their shape if they are to") {
  for (const double height : {1e-2, 1e-4, 1e-5}) {
    CAPTURE(height);
    Mesh mesh = box_with_body(5, Volumes::tetrahedra);
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      Vec3 p = mesh.coordinates.xyz(i);
      // Faces are not at right angles to the layers: no corner is nearly a cube's.
      p.z() = height * (p.z() + 0.3 * std::sin(3 * p.x()) + 0.2 * std::cos(4 * p.y()));
      mesh.coordinates.set_xyz(i, p);
    }
    SmoothCommand command;
    command.smooth.targets = {.automatic = 0, .rest = 1};
    const CommandResult result = execute(command, make_state(mesh));
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(largest_difference(result.state.mesh.coordinates, mesh.coordinates) < 1e-4 * height);
  }
}

}  // namespace winslow::test
