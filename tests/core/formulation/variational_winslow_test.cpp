#include "core/formulation/variational_winslow.h"
#include "core/formulation/target_shapes.h"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/error.h"
#include "core/formulation/distortion.h"
#include "core/parallel/parallel_for.h"
#include "support/formulations.h"
#include "support/polygon_meshes.h"
#include "support/vcv.h"

using namespace winslow;
using namespace winslow::test;

namespace {

struct Sample {
  Mesh mesh;
  VirtualControlVolumes vcv;
};

/// A valid mesh, its nodes moved at random, with VCVs of random angles and lengths.
Sample make_sample(std::uint64_t seed, const MeshData& data, double perturbation = 0.15) {
  Random random(seed);
  Mesh mesh = make_mesh(data);
  perturb(mesh, random, perturbation);
  VirtualControlVolumes vcv(mesh.topology);
  for (const Index node : mesh.topology->interior_nodes()) {
    const auto n = static_cast<Index>(vcv.angles(node).size());
    if (n < 3) continue;
    std::vector<double> lengths;
    for (Index k = 0; k < n; ++k) lengths.push_back(random.uniform(0.5, 2));
    vcv.set(node, random_angles(random, n), lengths);
  }
  return {std::move(mesh), std::move(vcv)};
}

Sample make_sample(std::uint64_t seed, Cells cells) {
  return make_sample(seed, square_with_hole(10, cells));
}

VariationalWinslow formulation(const Sample& sample, const TargetBlend& blend,
                               const PenaltyOptions& penalty, int threads = 1) {
  return {free_interior(sample.mesh.topology),
          TargetShapes::build(sample.vcv, blend, &sample.mesh.coordinates), penalty, threads};
}

std::vector<double> random_direction(const Topology& topology, Random& random, double length) {
  std::vector<double> direction(2 * topology.interior_nodes().size());
  for (double& d : direction) d = random.uniform(-length, length);
  return direction;
}

Coordinates moved(const Mesh& mesh, const std::vector<double>& direction, double step) {
  Coordinates x = mesh.coordinates;
  const auto free = mesh.topology->interior_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    x.set_xy(free[i], x.xy(free[i]) + step * Vec2(direction[2 * i], direction[2 * i + 1]));
  }
  return x;
}

std::vector<double> product(const SparseMatrix& matrix, const std::vector<double>& v) {
  std::vector<double> out(v.size(), 0.0);
  for (std::size_t row = 0; row + 1 < matrix.pattern->offsets.size(); ++row) {
    for (Index e = matrix.pattern->offsets[row]; e < matrix.pattern->offsets[row + 1]; ++e) {
      const double* b = &matrix.values[4 * at(e)];
      const std::size_t column = at(matrix.pattern->columns[at(e)]);
      out[2 * row] += b[0] * v[2 * column] + b[1] * v[2 * column + 1];
      out[2 * row + 1] += b[2] * v[2 * column] + b[3] * v[2 * column + 1];
    }
  }
  return out;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double a : v) sum += a * a;
  return std::sqrt(sum);
}

const std::array<TargetBlend, 4> blends{TargetBlend{0, 1, 0, 0}, TargetBlend{0, 0, 1, 0},
                                        TargetBlend{0, 0, 0, 1}, TargetBlend{0, 0.5, 0.3, 0.2}};
const std::array<PenaltyOptions, 5> penalties{PenaltyOptions{8, 1.78}, PenaltyOptions{1, 0},
                                              PenaltyOptions{4, 0}, PenaltyOptions{2.5, 0},
                                              PenaltyOptions{1, 0, 30}};

/// What a kernel makes of one triangle.
std::array<double, 4 * distortion::TriangleSum::size> hessian_of(
    const std::array<std::array<double, 2>, 3>& corner, const ShapeTerm& term,
    const distortion::PenaltyConstants& penalty, double inverse_limit = 0) {
  const std::array<Index, 3> nodes{0, 1, 2};
  const std::array<Index, 2> offsets{0, 1};
  const Index triangle = 0;
  distortion::SimplexData data;
  data.x = corner[0].data();
  data.nodes = nodes.data();
  data.offsets = offsets.data();
  data.terms = &term.ab;
  if (inverse_limit > 0) data.inverse_limits = &inverse_limit;
  data.penalty = penalty;
  std::array<double, 4 * distortion::TriangleSum::size> out{};
  distortion::fastest_kernel<2>().sum(data, &triangle, 1, 0, out.data());
  return out;
}

/// A displacement of all constrained nodes.
Coordinates boundary_displacement(const Topology& topology, Random& random) {
  Coordinates displacement(2, topology.node_count());
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (!topology.on_boundary(node)) continue;
    displacement.set_xy(node, Vec2(random.uniform(-1, 1), random.uniform(-1, 1)));
  }
  return displacement;
}

}  // namespace

TEST_CASE("the gradient is that of the energy, the Hessian that of the gradient") {
  std::uint64_t seed = 0;
  constexpr double much = 0.15, little = 0.05;
  const std::vector<std::pair<MeshData, double>> meshes{
      {square_with_hole(10, Cells::triangles), much},
      {square_with_hole(10, Cells::quads), much},
      {square_with_hole(10, Cells::mixed), much},
      {quadtree_with_hole(8), little},
      {dual_of(make_mesh(square_with_hole(8, Cells::triangles))), little}};
  for (const auto& mesh : meshes) {
    for (const TargetBlend& blend : blends) {
      for (const PenaltyOptions& penalty : penalties) {
        CAPTURE(mesh.first.element_count());
        CAPTURE(penalty.exponent);
        Sample sample = make_sample(++seed, mesh.first, mesh.second);
        Random random(seed);
        const VariationalWinslow energy = formulation(sample, blend, penalty);
        // Off the rest mesh, where the gradient of its own shapes vanishes.
        const auto offset = random_direction(*sample.mesh.topology, random, 1);
        sample.mesh.coordinates = moved(sample.mesh, offset, 3e-3);
        REQUIRE(check_validity(*sample.mesh.topology, sample.mesh.coordinates, 1).inverted == 0);
        const auto direction = random_direction(*sample.mesh.topology, random, 1);
        constexpr double h = 1e-6;
        const Coordinates plus = moved(sample.mesh, direction, h);
        const Coordinates minus = moved(sample.mesh, direction, -h);

        SparseMatrix hessian;
        std::vector<double> residual(direction.size());
        const Linearisation assembled =
            energy.linearise(sample.mesh.coordinates, Curvature::exact, hessian, residual);
        CHECK(assembled.energy ==
              doctest::Approx(energy.energy(sample.mesh.coordinates)).epsilon(1e-13));
        double slope = 0;
        for (std::size_t i = 0; i < direction.size(); ++i) slope -= residual[i] * direction[i];
        const double difference = (energy.energy(plus) - energy.energy(minus)) / (2 * h);
        CHECK(std::abs(slope - difference) <= 1e-6 * (std::abs(slope) + norm(residual)));

        std::vector<double> at_plus(direction.size()), at_minus(direction.size());
        energy.residual(plus, at_plus);
        energy.residual(minus, at_minus);
        std::vector<double> error = product(hessian, direction);
        const double size = norm(error);
        for (std::size_t i = 0; i < error.size(); ++i) {
          error[i] += (at_plus[i] - at_minus[i]) / (2 * h);
        }
        CHECK(norm(error) <= 1e-6 * size);
      }
    }
  }
}

TEST_CASE("the answer to a moving boundary is the derivative of the residual") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    const Sample sample = make_sample(7, cells);
    Random random(3);
    const VariationalWinslow energy = formulation(sample, {0, 0.5, 0.5, 0}, {});
    const Topology& topology = *sample.mesh.topology;
    const Coordinates displacement = boundary_displacement(topology, random);
    constexpr double h = 1e-6;
    Coordinates plus = sample.mesh.coordinates, minus = plus;
    for (Index node = 0; node < topology.node_count(); ++node) {
      plus.set_xy(node, plus.xy(node) + h * displacement.xy(node));
      minus.set_xy(node, minus.xy(node) - h * displacement.xy(node));
    }
    const std::size_t n = 2 * topology.interior_nodes().size();
    std::vector<double> at_plus(n), at_minus(n), response(n);
    energy.residual(plus, at_plus);
    energy.residual(minus, at_minus);
    energy.boundary_response(sample.mesh.coordinates, displacement, response);
    const double size = norm(response);
    for (std::size_t i = 0; i < n; ++i) response[i] -= (at_plus[i] - at_minus[i]) / (2 * h);
    CHECK(norm(response) <= 1e-6 * size);
  }
}

TEST_CASE("a triangle's projected Hessian is its Hessian without the negative eigenvalues") {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const std::array<std::array<double, 2>, 3> corner{{
        {random.uniform(-1, 1), random.uniform(-1, 1)},
        {random.uniform(-1, 1), random.uniform(-1, 1)},
        {random.uniform(-1, 1), random.uniform(-1, 1)},
    }};
    const distortion::Corner2 q(corner[0].data(), corner[1].data(), corner[2].data());
    if (q.d < 0.05) continue;
    const PenaltyOptions options = penalties[at(random.index(5))];
    // A guard within its limit, one beyond it, or no guard.
    const double inverse_limit =
        options.knee > 0 ? std::array<double, 3>{0, 0.01, 1}[at(random.index(3))] : 0;
    const distortion::PenaltyFunction psi(options, inverse_limit > 0);
    // The projection belongs to J = [u v] root, so it is compared there: in a target whose edges
    // are orthonormal, J is the pair of edges itself.
    const ShapeTerm unit{1, 1, 0, 1};
    Eigen::Matrix4d exact, projected;
    const auto fill = [&](Eigen::Matrix4d& out, bool project) {
      std::array<double, 4 * distortion::TriangleSum::size> blocks{};
      if (project) {
        distortion::add_projected_blocks(q, unit, psi, inverse_limit, blocks.data());
      } else {
        blocks = hessian_of(corner, unit, psi.constants(), inverse_limit);
      }
      using Block = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
      const Eigen::Map<const Block> ab(&blocks[distortion::TriangleSum::ab]);
      const Eigen::Map<const Block> ac(&blocks[distortion::TriangleSum::ac]);
      const Eigen::Map<const Block> bc(&blocks[distortion::TriangleSum::bc]);
      // The rows of b and c: blocks over the two edges.
      out << -ab.transpose() - bc, bc, bc.transpose(), -ac.transpose() - bc.transpose();
    };
    fill(exact, false);
    fill(projected, true);
    CHECK((exact - exact.transpose()).norm() <= 1e-9 * exact.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(exact);
    const Eigen::Matrix4d expected = eigen.eigenvectors() *
                                     eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                     eigen.eigenvectors().transpose();
    CHECK((projected - expected).norm() <= 1e-8 * expected.norm());
  }
}

TEST_CASE("perfect elements have distortion one and no force") {
  const Mesh mesh = make_mesh(square(6, Cells::quads));
  const VirtualControlVolumes vcv(mesh.topology);
  for (const TargetBlend& blend : {TargetBlend{0, 1, 0, 0}, TargetBlend{0, 0, 1, 0}}) {
    const VariationalWinslow energy(free_interior(mesh.topology),
                                    TargetShapes::build(vcv, blend, nullptr), {4, 0}, 1);
    // Every element has weight one, however many of its nodes lie at the boundary; the four of the
    // corners have one corner triangle that cannot change.
    CHECK(energy.energy(mesh.coordinates) == doctest::Approx(36));
    CHECK(energy.residual(mesh.coordinates, {}).max < 1e-13);
    CHECK(energy.worst_distortion(mesh.coordinates) == doctest::Approx(1));
  }
}

TEST_CASE("the rest mesh is the solution where its own shapes are the target") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    const Sample sample = make_sample(5, cells);
    const VariationalWinslow energy = formulation(sample, {0, 0, 0, 1}, {});
    CHECK(energy.residual(sample.mesh.coordinates, {}).max < 1e-12);
    CHECK(energy.worst_distortion(sample.mesh.coordinates) == doctest::Approx(1));
  }
}

TEST_CASE("an inverted element has infinite energy, and a finite one when regularised") {
  Random random(2);
  Mesh mesh = make_mesh(square(6, Cells::triangles));
  tangle(mesh, random);
  const VirtualControlVolumes vcv(mesh.topology);
  const VariationalWinslow energy(free_interior(mesh.topology),
                                  TargetShapes::build(vcv, TargetBlend::regular(), nullptr), {1, 0},
                                  1);
  CHECK(std::isinf(energy.energy(mesh.coordinates)));
  const Regularisation regularisation{std::vector<double>(energy.shapes().cells.size(), 0.01)};
  const double value = energy.regularised_energy(mesh.coordinates, regularisation);
  CHECK(std::isfinite(value));

  // Its gradient against differences, its Hessian positive semidefinite.
  const auto direction = random_direction(*mesh.topology, random, 1);
  SparseMatrix hessian;
  std::vector<double> residual(direction.size());
  energy.linearise_regularised(mesh.coordinates, regularisation, hessian, residual);
  double slope = 0;
  for (std::size_t i = 0; i < direction.size(); ++i) slope -= residual[i] * direction[i];
  constexpr double h = 1e-7;
  const double difference =
      (energy.regularised_energy(moved(mesh, direction, h), regularisation) -
       energy.regularised_energy(moved(mesh, direction, -h), regularisation)) /
      (2 * h);
  CHECK(slope == doctest::Approx(difference).epsilon(1e-5));
  for (int trial = 0; trial < 20; ++trial) {
    const auto v = random_direction(*mesh.topology, random, 1);
    const auto hv = product(hessian, v);
    double curvature = 0;
    for (std::size_t i = 0; i < v.size(); ++i) curvature += v[i] * hv[i];
    CHECK(curvature >= -1e-10 * norm(v) * norm(hv));
  }
}

TEST_CASE("no result depends on the number of threads, to the last bit") {
  Mesh mesh = make_mesh(square(100, Cells::mixed));
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec2 p = mesh.coordinates.xy(node);
    mesh.coordinates.set_xy(node, p + 0.002 * Vec2(std::sin(50 * p.y()), std::cos(70 * p.x())));
  }
  REQUIRE(mesh.topology->interior_nodes().size() > 2 * parallel_block);
  const VirtualControlVolumes vcv(mesh.topology);
  const TargetShapes shapes = TargetShapes::build(vcv, {0, 0.5, 0.5, 0}, nullptr);
  const VariationalWinslow one(free_interior(mesh.topology), shapes, {}, 1),
      four(free_interior(mesh.topology), shapes, {}, 4);
  CHECK(one.energy(mesh.coordinates) == four.energy(mesh.coordinates));
  const std::size_t n = 2 * mesh.topology->interior_nodes().size();
  SparseMatrix a, b;
  std::vector<double> ra(n), rb(n);
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    const Linearisation la = one.linearise(mesh.coordinates, curvature, a, ra);
    const Linearisation lb = four.linearise(mesh.coordinates, curvature, b, rb);
    CHECK(la.energy == lb.energy);
    CHECK(la.norms.max == lb.norms.max);
    CHECK(la.norms.rms == lb.norms.rms);
    CHECK(a.values == b.values);
    CHECK(ra == rb);
  }
}

TEST_CASE("targets that make no sense are refused") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  const VirtualControlVolumes vcv(mesh.topology);
  CHECK_THROWS_AS(TargetShapes::build(vcv, {0, 0, 0, 0}, nullptr), UsageError);
  CHECK_THROWS_AS(TargetShapes::build(vcv, {0, -1, 2, 0}, nullptr), UsageError);
  CHECK_THROWS_AS(TargetShapes::build(vcv, {0, 0, 0, 1}, nullptr), UsageError);
  Random random(1);
  Mesh tangled = mesh;
  tangle(tangled, random);
  CHECK_THROWS_AS(TargetShapes::build(vcv, {0, 0, 0, 1}, &tangled.coordinates), MeshError);
}
