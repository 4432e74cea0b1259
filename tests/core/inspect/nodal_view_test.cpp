#include "core/inspect/nodal_view.h"

#include <doctest/doctest.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/inspect/element_field.h"
#include "support/formulations.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A regular star, its nodes moved by x -> A x + b: the VCV's own shape under an affine map.
Mesh affine_star(Index n, const Eigen::Matrix2d& a, const Vec2& b) {
  Mesh mesh = make_mesh(regular_star(n));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    mesh.coordinates.set_xy(i, a * mesh.coordinates.xy(i) + b);
  }
  return mesh;
}

}  // namespace

TEST_CASE("an affine map of the VCV: its matrix is the nodal Jacobian, its residual zero") {
  Eigen::Matrix2d a;
  a << 2, 1, -0.5, 3;
  for (Index n = 3; n <= 9; ++n) {
    CAPTURE(n);
    const Mesh mesh = affine_star(n, a, Vec2(10, -4));
    const NodalView view = inspect_node(VirtualControlVolumes(mesh.topology), mesh.coordinates, 0);
    REQUIRE(view.neighbours.size() == static_cast<std::size_t>(n));
    // The VCV's edge 0 lies on the x axis, wherever that neighbour was in the star.
    Eigen::Matrix2d jacobian;
    jacobian << view.gradient.rx, view.gradient.ry;
    const Eigen::Vector2d singular = Eigen::JacobiSVD<Eigen::Matrix2d>(a).singularValues();
    CHECK(jacobian.determinant() == doctest::Approx(a.determinant()));
    CHECK(view.singular_values[0] == doctest::Approx(singular[0]));
    CHECK(view.singular_values[1] == doctest::Approx(singular[1]));
    CHECK(view.kappa == doctest::Approx(singular[0] / singular[1]));
    CHECK(view.scaled_residual < 1e-14);
    CHECK((view.position - Vec2(10, -4)).norm() < 1e-14);
    CHECK_FALSE(view.edited);
    double area = 0, turn = 0;
    for (std::size_t k = 0; k < view.neighbours.size(); ++k) {
      CHECK((jacobian * view.vcv.points[k] - view.physical.points[k]).norm() < 1e-12);
      CHECK(view.physical.areas[k] == doctest::Approx(a.determinant() * view.vcv.areas[k]));
      area += view.vcv.areas[k];
      turn += view.physical.angles[k];
    }
    CHECK(area == doctest::Approx(0.5 * n * std::sin(2 * pi / n)));
    CHECK(turn == doctest::Approx(2 * pi));
  }
}

TEST_CASE("a conformal map: equal weights, kappa 1, and the VCV turned over the star fits it") {
  const double angle = 0.7;
  Eigen::Matrix2d a;
  a << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Mesh mesh = affine_star(7, 3 * a, Vec2(1, 2));
  const NodalView view = inspect_node(VirtualControlVolumes(mesh.topology), mesh.coordinates, 0);
  CHECK(view.kappa == doctest::Approx(1));
  CHECK(view.coefficients.alpha == doctest::Approx(1));
  CHECK(std::abs(view.coefficients.beta) < 1e-14);
  for (const double w : view.weights) CHECK(w == doctest::Approx(2 * std::tan(pi / 7)));
  CHECK(view.smallest_weight == doctest::Approx(1));
  const double turn = fitted_turn(view.vcv, view.physical);
  for (std::size_t k = 0; k < 7; ++k) {
    const Vec2& v = view.vcv.points[k];
    const Vec2 turned(std::cos(turn) * v.x() - std::sin(turn) * v.y(),
                      std::sin(turn) * v.x() + std::cos(turn) * v.y());
    CHECK((3 * turned - view.physical.points[k]).norm() < 1e-12);
  }
}

TEST_CASE("a node's view agrees with an integration triangle by triangle") {
  constexpr std::uint64_t seed = 11;
  CAPTURE(seed);
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    const Sample sample = make_sample(seed, cells, false);
    const PointwiseWinslow operator_ = pointwise(sample.vcv);
    for (const Index node : sample.mesh.topology->interior_nodes()) {
      const NodalView view = inspect_node(sample.vcv, sample.mesh.coordinates, node);
      if (view.neighbours.size() < 3) continue;
      std::vector<Vec2> around;
      for (const Index k : view.neighbours) around.push_back(sample.mesh.coordinates.xy(k));
      const BruteForce brute =
          integrate(view.vcv.points, view.position, around, Eigen::Matrix2d::Identity());
      CHECK((view.gradient.rx - brute.gradient.col(0)).norm() < 1e-12);
      CHECK((view.gradient.ry - brute.gradient.col(1)).norm() < 1e-12);
      const Eigen::Matrix2d k = winslow_matrix(brute.gradient);
      const Vec2 flux =
          integrate(view.vcv.points, view.position, around, 2 * k / k.trace()).residual;
      CHECK((view.residual - flux).norm() < 1e-12);
      CHECK(view.edited == sample.vcv.edited(node));
      std::vector<double> weights(view.weights.size());
      operator_.weights(sample.mesh.coordinates, node, weights);
      CHECK(view.weights == weights);
    }
  }
}

TEST_CASE("what has no VCV says why") {
  MeshData data = regular_star(5);
  data.coordinates.push_xy({9, 9});
  const Mesh mesh = make_mesh(data);
  const VirtualControlVolumes vcv(mesh.topology);
  const auto message = [&](Index node) {
    try {
      inspect_node(vcv, mesh.coordinates, node);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message(0).empty());
  CHECK(message(3) == "node 3 lies on the boundary or on a marker: it has no VCV");
  CHECK(message(6) == "node 6 belongs to no element: it has no VCV");
  CHECK(message(7) == "the mesh has no node 7: its nodes count from 0 to 6");
  CHECK(message(-1) == "the mesh has no node -1: its nodes count from 0 to 6");
}

TEST_CASE("fields: the value of each node is that of its view, an element has its worst node's") {
  constexpr std::uint64_t seed = 5;
  CAPTURE(seed);
  const Sample sample = make_sample(seed, Cells::mixed, false);
  const Topology& topology = *sample.mesh.topology;
  const Coordinates& x = sample.mesh.coordinates;
  for (const NodalField field :
       {NodalField::kappa, NodalField::smallest_weight, NodalField::residual}) {
    const auto at_nodes = node_values(sample.vcv, x, field, 1);
    CHECK(at_nodes.size() == static_cast<std::size_t>(topology.node_count()));
    for (Index node = 0; node < topology.node_count(); ++node) {
      if (topology.on_boundary(node)) {
        CHECK(std::isnan(at_nodes[at(node)]));
        continue;
      }
      const NodalView view = inspect_node(sample.vcv, x, node);
      const double expected = field == NodalField::kappa      ? view.kappa
                              : field == NodalField::residual ? view.scaled_residual
                                                              : view.smallest_weight;
      CHECK(at_nodes[at(node)] == doctest::Approx(expected));
    }
    const auto at_elements = element_values(sample.vcv, x, field, 1);
    for (Index e = 0; e < topology.element_count(); ++e) {
      bool any = false, found = false;
      for (const Index node : topology.element(e)) {
        const double value = at_nodes[at(node)];
        if (std::isnan(value)) continue;
        any = true;
        found = found || value == at_elements[at(e)];
        CHECK((field == NodalField::smallest_weight ? value >= at_elements[at(e)]
                                                    : value <= at_elements[at(e)]));
      }
      CHECK(found == any);
      CHECK(std::isnan(at_elements[at(e)]) != any);
    }
  }
}

TEST_CASE("fields of walls on an annulus are its radii's") {
  constexpr Index sectors = 24, rings = 5;
  constexpr double growth = 1.3;
  const Mesh mesh = make_mesh(annulus(sectors, rings, growth, Cells::quads));
  const VirtualControlVolumes vcv(mesh.topology);
  const auto values = [&](WallField field) { return element_values(vcv, mesh.coordinates, field); };
  const auto height = values(WallField::first_height), tilt = values(WallField::first_edge_tilt),
             ratio = values(WallField::size_ratio);
  for (std::size_t e = 0; e < height.size(); ++e) {
    CHECK(ratio[e] == doctest::Approx(growth));
    const bool inner = e < static_cast<std::size_t>(sectors);  // the first ring comes first
    REQUIRE(std::isnan(height[e]) != inner);
    REQUIRE(std::isnan(tilt[e]) != inner);
    if (!inner) continue;
    CHECK(height[e] == doctest::Approx(growth - 1));
    CHECK(std::abs(tilt[e]) < 1e-5);
  }
}

TEST_CASE("fields do not depend on the number of threads, and have names to be found by") {
  const Mesh mesh = make_mesh(square(90, Cells::triangles));
  const VirtualControlVolumes vcv(mesh.topology);
  Mesh moved = mesh;
  constexpr std::uint64_t seed = 3;
  Random random(seed);
  perturb(moved, random);
  for (const ElementField& field : all_element_fields()) {
    CHECK(parse_field(field_info(field).name) == field);
    const auto one = element_values(vcv, moved.coordinates, field, 1);
    const auto four = element_values(vcv, moved.coordinates, field, 4);
    bool same = one.size() == four.size();
    for (std::size_t e = 0; same && e < one.size(); ++e) {
      same = one[e] == four[e] || (std::isnan(one[e]) && std::isnan(four[e]));
    }
    CHECK(same);
  }
  CHECK_THROWS_WITH_AS(parse_field("beauty"),
                       "found \"beauty\", expected one of normalized_jacobian, aspect_ratio, "
                       "condition_number, smallest_angle, largest_angle, skewness, area, kappa, "
                       "smallest_weight, residual, first_height, first_height_ratio, "
                       "first_edge_tilt, growth, size_ratio, layer, spacing_error",
                       UsageError);
}
