#include "core/formulation/target_metric.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/formulation/distortion.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/mesh/element_type.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace winslow::test {

namespace {

/// A corner of three edges that are all long, in a tetrahedron of this height.
Edges3 flat_corner(double height) {
  Edges3 edges;
  edges << 1, 0.3, -0.2, 0.1, 1.2, 0.9, height, -2 * height, 3 * height;
  return edges;
}

}  // namespace

TEST_CASE("the quick stretch is that of the singular values to within its error") {
  Random random(3);
  const auto number = [&] { return random.uniform(-1, 1); };
  int compared = 0, beyond = 0;
  for (int k = 0; k < 4000; ++k) {
    Edges3 a, b;
    for (Edges3* edges : {&a, &b}) {
      do {
        *edges = Edges3::NullaryExpr(number);
      } while (!(edges->determinant() > 1e-3));
      edges->row(k % 3) *= std::pow(10.0, random.uniform(-1, 0));
    }
    if (k % 10 == 0) b = a * random.uniform(0.5, 2);                             // similar
    if (k % 10 == 1) b = Vec3(1, 1, 1 + random.uniform(0, 9)).asDiagonal() * a;  // two alike
    if (k % 10 == 2) b = Vec3(2, 2, 2 - random.uniform(0, 1.9)).asDiagonal() * a;
    const Eigen::Matrix3d metric = volume_metric(b);
    const Eigen::Matrix3d lower = volume_metric(a).llt().matrixL();
    const double stretch = stretch_between(volume_metric(a), metric);
    CHECK(RelativeMetric(volume_metric(a), metric).stretch() == stretch);
    const double quick = quick_stretch(lower, metric);
    if (stretch > 3) {
      CHECK(quick > 2.9);
      ++beyond;
    } else {
      CHECK(std::abs(quick - stretch) < stretch_error);
      ++compared;
    }
  }
  CHECK(compared > 1000);
  CHECK(beyond > 100);
}

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

namespace {

/// One corner with three edges, and its target.
CellTargets<3> corner_with(const Eigen::Matrix3d& metric) {
  CellTargets<3> targets;
  targets.cells = {{0, 1, 2, 3}};
  targets.offsets = {0, 1};
  targets.terms = {volume_term(metric, 1)};
  return targets;
}

Coordinates random_corner(Random& random) {
  Coordinates x(3, 4);
  do {
    for (double& c : x.values()) c = random.uniform(-1, 1);
  } while (distortion::Corner3({x.xyz(0), x.xyz(1), x.xyz(2), x.xyz(3)}).d < 0.02);
  return x;
}

double scaled_jacobian(const Coordinates& x) {
  Edges3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = (x.xyz(k + 1) - x.xyz(0)).normalized();
  return edges.determinant();
}

double distortion_at(const CellTargets<3>& targets, const Coordinates& x) {
  return distortion::Corner3({x.xyz(0), x.xyz(1), x.xyz(2), x.xyz(3)}).distortion(targets.terms[0]);
}

}  // namespace

TEST_CASE(
    "a right-angled target with a corner's lengths measures its scaled Jacobian, elsewhere "
    "no less than that") {
  Random random(5);
  const auto right = corner_with(Eigen::Matrix3d::Identity());
  for (int sample = 0; sample < 100; ++sample) {
    const Coordinates x = random_corner(random), y = random_corner(random);
    const auto targets = with_corner_lengths(right, SpacePoints(x));
    const double here = std::pow(scaled_jacobian(x), -2.0 / 3);
    CHECK(std::abs(distortion_at(targets, x) - here) <= 1e-10 * here);
    const double there = std::pow(scaled_jacobian(y), -2.0 / 3);
    CHECK(distortion_at(targets, y) >= there * (1 - 1e-10));
  }
}

TEST_CASE("the same of a hexahedron's tetrahedra at an edge, by the three edges that meet there") {
  Random random(8);
  const auto list = edge_tetrahedra(ElementType::hexahedron);
  const auto& metrics = regular_edge_metrics(ElementType::hexahedron);
  for (int sample = 0; sample < 100; ++sample) {
    const Coordinates x = random_corner(random), y = random_corner(random);
    for (std::size_t k = 0; k < list.size(); ++k) {
      // Even ones have their third edge at the second node, odd ones their second.
      const auto sine = [k](const Coordinates& at_place) {
        Edges3 edges;
        const Index third = k % 2 == 0 ? 1 : 0, second = 1 - third;
        edges << at_place.xyz(1) - at_place.xyz(0), at_place.xyz(2) - at_place.xyz(second),
            at_place.xyz(3) - at_place.xyz(third);
        return edges.colwise().normalized().eval().determinant();
      };
      const auto targets = with_corner_lengths(corner_with(metrics[k]), SpacePoints(x));
      const double here = std::pow(sine(x), -2.0 / 3), there = std::pow(sine(y), -2.0 / 3);
      CHECK(std::abs(distortion_at(targets, x) - here) <= 1e-9 * here);
      CHECK(distortion_at(targets, y) >= there * (1 - 1e-9));
    }
  }
}

TEST_CASE("the same of a quadrilateral's corner, whose distortion is 1 / sin") {
  Random random(6);
  CellTargets<2> square;
  square.cells = {{0, 1, 2}};
  square.offsets = {0, 1};
  square.terms = {ShapeTerm{1, 1, 0, 1}};
  const auto f = [](const CellTargets<2>& targets, const Vec2& u, const Vec2& v) {
    const ShapeTerm& t = targets.terms[0];
    return (t.ab * u.squaredNorm() + t.ac * v.squaredNorm() + t.bc * (v - u).squaredNorm()) /
           (2 * (u.x() * v.y() - u.y() * v.x()));
  };
  const auto sine = [](const Vec2& u, const Vec2& v) {
    return (u.x() * v.y() - u.y() * v.x()) / (u.norm() * v.norm());
  };
  for (int sample = 0; sample < 100; ++sample) {
    const Vec2 u(random.uniform(0.1, 2), random.uniform(-0.1, 0.1));
    const Vec2 v(random.uniform(-1, 1), random.uniform(0.2, 3));
    for (const int dimension : {2, 3}) {  // of a surface mesh, too
      Coordinates x(dimension, 3);
      for (int k = 0; k < 2; ++k) {
        x.values()[static_cast<std::size_t>(dimension + k)] = u[k];
        x.values()[static_cast<std::size_t>(2 * dimension + k)] = v[k];
      }
      const auto targets = dimension == 2 ? with_corner_lengths(square, PlanePoints(x))
                                          : with_corner_lengths(square, SpacePoints(x));
      CHECK(std::abs(f(targets, u, v) - 1 / sine(u, v)) <= 1e-10 / sine(u, v));
      const Vec2 other(0.3, 0.7);
      CHECK(f(targets, u, other) >= (1 - 1e-10) / sine(u, other));
    }
  }
}

TEST_CASE("at a prism's corner the height takes its own length, simplices keep their targets") {
  Edges3 prism;
  prism.col(0) = Vec3(1, 0, 0);
  prism.col(1) = Vec3(0.5, std::sqrt(0.75), 0);
  prism.col(2) = Vec3(0, 0, 1);
  Coordinates x(3, 4);  // the same, three times as high
  for (int k = 0; k < 3; ++k) x.set_xyz(k + 1, prism.col(k) * (k == 2 ? 3.0 : 1.0));
  const auto targets = corner_with(volume_metric(prism));
  CHECK(distortion_at(targets, x) > 1.2);
  CHECK(std::abs(distortion_at(with_corner_lengths(targets, SpacePoints(x)), x) - 1) <= 1e-12);

  Random random(7);
  const auto tetrahedron = corner_with(regular_metrics(ElementType::tetrahedron)[0]);
  const Coordinates corner = random_corner(random);
  const auto after = with_corner_lengths(tetrahedron, SpacePoints(corner));
  CHECK(metric_of(after.terms[0]) == metric_of(tetrahedron.terms[0]));
}

TEST_CASE("a bounded penalty: slopes by differences, infinite from the bound on") {
  const double bound = 3;
  const distortion::PenaltyFunction psi({.exponent = 1, .knee = 0, .bound = bound});
  const auto value = [&](double f) { return f / (1 - f / bound); };
  for (const double f : {1.0, 1.7, 2.5, 2.9}) {
    const double h = 1e-5;
    const double first = (value(f + h) - value(f - h)) / (2 * h);
    const double second = (value(f + h) - 2 * value(f) + value(f - h)) / (h * h);
    CHECK(std::abs(psi.slopes(f).first - first) <= 1e-5 * first);
    CHECK(std::abs(psi.slopes(f).second - second) <= 1e-3 * second);
  }
  // The energies of meshes, at the largest distortion and a little beyond.
  const Mesh plane = make_mesh(square(3, Cells::quads));
  const Mesh space = shaken_box(3, 0.2, 3, Volumes::hexahedra);
  const VariationalWinslow flat(
      std::make_shared<const NodeClasses>(plane.topology),
      TargetShapes::build(VirtualControlVolumes(plane.topology), TargetBlend::regular(), nullptr),
      {}, 1);
  const VolumeWinslow solid(
      std::make_shared<const NodeClasses>(space.topology),
      volume_targets(*space.topology, nullptr, TargetBlend::regular(), nullptr, 1), {}, 1);
  const auto check = [](const VariationalForm& form, const Coordinates& x) {
    const double worst = form.worst_distortion(x);
    const auto energy = [&](double limit) {
      return form.with_penalty({.exponent = 1, .knee = 0, .bound = limit})->energy(x);
    };
    CHECK(std::isfinite(energy(worst * (1 + 1e-6))));
    CHECK(std::isinf(energy(worst * (1 - 1e-6))));
    CHECK(energy(1e12) == doctest::Approx(form.with_penalty({1, 0})->energy(x)));
  };
  Coordinates shaken = plane.coordinates;
  Random random(8);
  for (const Index node : plane.topology->interior_nodes())
    shaken.set_xy(node, shaken.xy(node) + 0.05 * random.vector());
  check(flat, shaken);
  check(solid, space.coordinates);
}
