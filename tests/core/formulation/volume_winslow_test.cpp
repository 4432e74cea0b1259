#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/formulation/distortion.h"
#include "core/formulation/simplex_kernel.h"
#include "core/formulation/target_path.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_form.h"
#include "core/formulation/variational_winslow.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "support/formulations.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A cube of elements whose interior nodes are off their places.
Mesh shaken_cube(Volumes volumes, double by = 0.05) {
  Mesh mesh = make_mesh(cube(3, volumes));
  Random random(7);
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec3 move(random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by));
    mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + move);
  }
  REQUIRE(check_validity(*mesh.topology, mesh.coordinates, 1).inverted == 0);
  return mesh;
}

VolumeWinslow form_of(const Mesh& mesh, const TargetBlend& blend, const PenaltyOptions& penalty) {
  const VolumeVcvs vcvs(mesh.topology);
  return {free_interior(mesh.topology),
          volume_targets(*mesh.topology, &vcvs, blend, &mesh.coordinates, 1), penalty, 1};
}

std::vector<double> random_rates(std::size_t unknowns, Random& random) {
  std::vector<double> rates(unknowns);
  for (double& rate : rates) rate = random.uniform(-1, 1);
  return rates;
}

Coordinates moved(const VolumeWinslow& form, Coordinates x, const std::vector<double>& rates,
                  double step) {
  form.advance(rates, step, x);
  return x;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<double> product(const SparseMatrix& matrix, const std::vector<double>& v) {
  std::vector<double> out(v.size(), 0.0);
  const SparsityPattern& pattern = *matrix.pattern;
  for (std::size_t row = 0; row + 1 < pattern.offsets.size(); ++row) {
    for (Index e = pattern.offsets[row]; e < pattern.offsets[row + 1]; ++e) {
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c)
          out[3 * row + r] +=
              matrix.values[9 * at(e) + 3 * r + c] * v[3 * at(pattern.columns[at(e)]) + c];
      }
    }
  }
  return out;
}

/// One term a cell, one for each of its free nodes, and a bit of everything.
const std::vector<TargetBlend> blends{TargetBlend::regular(),
                                      {.automatic = 0, .vcv = 1},
                                      {.automatic = 0.2, .element = 0.3, .vcv = 0.4, .rest = 0.1}};
const std::vector<PenaltyOptions> penalties{{8, 1.78}, {1, 0}, {4, 0}, {2.5, 1.5}};
const PenaltyOptions bounded{.exponent = 1, .knee = 0, .bound = 30};

/// Gradient and Hessian along a random direction, against central differences.
void check_derivatives(const VolumeWinslow& form, const Coordinates& x) {
  Random random(3);
  const auto rates = random_rates(form.unknowns(), random);
  std::vector<double> residual(form.unknowns()), ahead(residual), behind(residual);
  SparseMatrix hessian;
  const Linearisation at_x = form.linearise(x, Curvature::exact, hessian, residual);
  CHECK(at_x.energy == doctest::Approx(form.energy(x)).epsilon(1e-13));
  constexpr double h = 1e-6;
  const Coordinates plus = moved(form, x, rates, h), minus = moved(form, x, rates, -h);
  const double slope = (form.energy(plus) - form.energy(minus)) / (2 * h);
  CHECK(-dot(residual, rates) == doctest::Approx(slope).epsilon(1e-6));
  form.residual(plus, ahead);
  form.residual(minus, behind);
  const auto expected = product(hessian, rates);
  double error = 0, size = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    const double difference = -(ahead[i] - behind[i]) / (2 * h) - expected[i];
    error += difference * difference;
    size += expected[i] * expected[i];
  }
  CHECK(std::sqrt(error) < 1e-6 * std::sqrt(size));
}

}  // namespace

TEST_CASE("in space the gradient is that of the energy, the Hessian that of the gradient") {
  for (const Volumes volumes : all_volumes) {
    for (const TargetBlend& blend : blends) {
      for (const PenaltyOptions& penalty : penalties) {
        CAPTURE(name_of(volumes));
        CAPTURE(blend.vcv);
        CAPTURE(penalty.exponent);
        check_derivatives(form_of(shaken_cube(volumes), blend, penalty),
                          shaken_cube(volumes).coordinates);
      }
      check_derivatives(form_of(shaken_cube(volumes), blend, bounded),
                        shaken_cube(volumes).coordinates);
    }
  }
}

TEST_CASE("in space residual and linearisation agree, and so do one and two threads") {
  const Mesh mesh = shaken_cube(Volumes::mixed, 0.02);
  const auto targets =
      volume_targets(*mesh.topology, nullptr, TargetBlend::automatically(), &mesh.coordinates, 1);
  const VolumeWinslow one(free_interior(mesh.topology), targets, {}, 1),
      two(free_interior(mesh.topology), targets, {}, 2);
  std::vector<double> r1(one.unknowns()), r2(r1), r3(r1);
  SparseMatrix h1, h2;
  const Linearisation l1 = one.linearise(mesh.coordinates, Curvature::exact, h1, r1);
  const Linearisation l2 = two.linearise(mesh.coordinates, Curvature::exact, h2, r2);
  const ResidualNorms norms = one.residual(mesh.coordinates, r3);
  CHECK(r1 == r2);
  CHECK(r1 == r3);
  CHECK(two.residual(mesh.coordinates, r2).max == norms.max);
  CHECK(r2 == r3);
  CHECK(h1.values == h2.values);
  CHECK(l1.energy == l2.energy);
  CHECK(norms.max == doctest::Approx(l1.norms.max).epsilon(1e-12));
}

TEST_CASE("the projected Hessian of a tetrahedron is the exact one without its negative part") {
  Random random(5);
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  const auto full = [](const double* blocks) {
    Matrix12 h = Matrix12::Zero();
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b, blocks += 9) {
        const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> block(blocks);
        h.block<3, 3>(3 * a, 3 * b) = block;
        h.block<3, 3>(3 * b, 3 * a) = block.transpose();
        h.block<3, 3>(3 * a, 3 * a) -= block;
        h.block<3, 3>(3 * b, 3 * b) -= block.transpose();
      }
    }
    return h;
  };
  for (const PenaltyOptions& penalty : penalties) {
    const distortion::PenaltyFunction psi(penalty);
    for (int sample = 0; sample < 20; ++sample) {
      std::array<Vec3, 4> p;
      Edges3 target;
      do {
        for (Vec3& point : p)
          for (double& c : point) c = random.uniform(-1, 1);
        for (double& c : target.reshaped()) c = random.uniform(-1, 1);
      } while (distortion::Corner3(p).d < 0.05 || target.determinant() < 0.05);
      const VolumeTerm term = volume_term(volume_metric(target), 0.7);
      const distortion::Corner3 corner(p);
      const std::array<Index, 4> nodes{0, 1, 2, 3};
      const std::array<Index, 2> offsets{0, 1};
      const Index cell = 0;
      distortion::SimplexData data;
      data.x = p[0].data();
      data.nodes = nodes.data();
      data.offsets = offsets.data();
      data.terms = &term.a11;
      data.penalty = psi.constants();
      std::array<double, 4 * distortion::SimplexLayout<3>::sum> sum{};
      const double energy = distortion::fastest_kernel<3>().sum(data, &cell, 1, 0, sum.data());
      // f by its definition: J maps the target to the tetrahedron.
      const Eigen::Matrix3d j = corner.edges * target.inverse();
      const double f = j.squaredNorm() / (3 * std::pow(j.determinant(), 2.0 / 3.0));
      CHECK(corner.distortion(term) == doctest::Approx(f).epsilon(1e-10));
      const double power = std::pow(f / (penalty.knee > 0 ? penalty.knee : 1), penalty.exponent);
      CHECK(energy == doctest::Approx(0.7 * (power + (penalty.knee > 0 ? f : 0))).epsilon(1e-10));
      const Matrix12 exact = full(sum.data());
      std::array<double, 4 * distortion::SimplexLayout<3>::sum> blocks{};
      distortion::fastest_kernel<3>().sum_projected(data, &cell, 1, 0, blocks.data());
      // The projection is done over J: E = J W, so dE = dJ W and the metric there is A.
      const Eigen::Matrix3d root = metric_of(term).llt().matrixL();
      Eigen::Matrix<double, 9, 12> to_j = Eigen::Matrix<double, 9, 12>::Zero();
      for (int node = 0; node < 4; ++node) {
        for (int k = 0; k < 3; ++k) {
          const double share = node == 0 ? -root.col(k).sum() : root(node - 1, k);
          to_j.block<3, 3>(3 * k, 3 * node) = share * Eigen::Matrix3d::Identity();
        }
      }
      // H = to_j^T H_j to_j; to_j has full rank 9.
      const auto inverse = to_j.completeOrthogonalDecomposition().pseudoInverse().eval();
      const Eigen::Matrix<double, 9, 9> over_j = inverse.transpose() * exact * inverse;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(over_j);
      const Eigen::Matrix<double, 9, 9> positive = eigen.eigenvectors() *
                                                   eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                                                   eigen.eigenvectors().transpose();
      const Matrix12 expected = to_j.transpose() * positive * to_j;
      CHECK((full(blocks.data()) - expected).norm() < 1e-7 * expected.norm());
    }
  }
}

TEST_CASE("the scales of first-order steps are those of the Hessian and the edges") {
  for (const Volumes volumes : all_volumes) {
    for (const TargetBlend& blend : {TargetBlend::regular(), TargetBlend::keeping()}) {
      CAPTURE(name_of(volumes));
      CAPTURE(blend.keep);
      const Mesh mesh = shaken_cube(volumes);
      const Coordinates& x = mesh.coordinates;
      const VolumeWinslow form = form_of(mesh, blend, PenaltyOptions{});
      std::vector<double> residual(form.unknowns());
      SparseMatrix hessian;
      form.linearise(x, Curvature::exact, hessian, residual);
      std::vector<double> edges(at(x.size()), 0.0), counts(edges);
      for (const auto& cell : form.shapes().cells) {
        for (const Index a : cell) {
          for (const Index b : cell) edges[at(a)] += (x.xyz(a) - x.xyz(b)).norm();
          counts[at(a)] += 3;
        }
      }
      const auto nodes = mesh.topology->interior_nodes();
      REQUIRE(3 * nodes.size() == residual.size());
      const auto first_order = form.first_order();
      std::vector<double> scales(nodes.size()), vectors(residual.size()), in_rows(vectors);
      first_order->scales(x, scales);
      for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = scales[i / 3];
      first_order->rates(x, vectors, in_rows);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double* block = &hessian.values[9 * at(hessian.pattern->diagonal[i])];
        const double scale =
            (block[0] + block[4] + block[8]) / 3 * edges[at(nodes[i])] / counts[at(nodes[i])];
        CHECK(in_rows[3 * i] == doctest::Approx(scale).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("the energy of tetrahedra is the same in every unit, however small or large") {
  const Mesh mesh = shaken_cube(Volumes::tetrahedra);
  const auto targets = volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr, 1);
  const auto count = static_cast<Index>(targets.cells.size());
  distortion::SimplexData data;
  data.nodes = targets.cells.front().data();
  data.offsets = targets.offsets.data();
  data.terms = &targets.terms.front().a11;
  data.penalty = distortion::PenaltyFunction(PenaltyOptions{}).constants();
  const auto energy_in = [&](double unit) {
    std::vector<double> x(mesh.coordinates.values().begin(), mesh.coordinates.values().end());
    for (double& v : x) v *= unit;
    data.x = x.data();
    const double energy = distortion::fastest_kernel<3>().energy(data, 0, count);
    CHECK(distortion::portable_kernel<3>().energy(data, 0, count) == energy);
    return energy;
  };
  const double expected = energy_in(1);
  REQUIRE(std::isfinite(expected));
  for (const double unit : {1e-98, 1e-90, 1e-30, 1e-3, 0.7, 3.0, 1e5, 1e40, 1e95, 1e98})
    CHECK(energy_in(unit) == doctest::Approx(expected).epsilon(1e-13));
}

TEST_CASE("the regularised energy of tetrahedra has its gradient on inverted ones, too") {
  Mesh mesh = shaken_cube(Volumes::tetrahedra);
  Random random(11);
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xyz(
        node, Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)));
  }
  REQUIRE(check_validity(*mesh.topology, mesh.coordinates, 1).inverted > 10);
  const VolumeWinslow form = form_of(mesh, TargetBlend::regular(), {1, 0});
  const auto sizes = form.cell_sizes(mesh.coordinates);
  const Regularisation soft = form.regularisation(mesh.coordinates, sizes, {0.5, 1});
  std::vector<double> residual(form.unknowns());
  SparseMatrix hessian;
  form.linearise_regularised(mesh.coordinates, soft, hessian, residual);
  const auto rates = random_rates(form.unknowns(), random);
  constexpr double h = 1e-7;
  const double slope = (form.regularised_energy(moved(form, mesh.coordinates, rates, h), soft) -
                        form.regularised_energy(moved(form, mesh.coordinates, rates, -h), soft)) /
                       (2 * h);
  CHECK(-dot(residual, rates) == doctest::Approx(slope).epsilon(1e-5));
  // What is left of the Hessian is convex.
  for (int k = 0; k < 10; ++k) {
    const auto v = random_rates(form.unknowns(), random);
    CHECK(dot(v, product(hessian, v)) > 0);
  }
}

TEST_CASE("the softer, the less an inverted tetrahedron costs, and without a limit") {
  Mesh mesh = shaken_cube(Volumes::tetrahedra);
  const VolumeWinslow form = form_of(mesh, TargetBlend::regular(), {1, 0});
  const auto sizes = form.cell_sizes(mesh.coordinates);
  const auto energy = [&](double softness) {
    return form.regularised_energy(
        mesh.coordinates, form.regularisation(mesh.coordinates, sizes, {softness, softness}));
  };
  // On a valid mesh the energy becomes that without regularisation.
  CHECK(energy(1e-8) == doctest::Approx(form.energy(mesh.coordinates)));
  const Index node = mesh.topology->interior_nodes()[0];
  mesh.coordinates.set_xyz(node, Vec3(1.5, 1.5, 1.5));
  REQUIRE(form.validity(mesh.coordinates).inverted > 0);
  double last = 0;
  for (const double softness : {1e-1, 1e-2, 1e-3, 1e-4}) {
    CAPTURE(softness);
    CHECK(energy(softness) > 10 * last);
    last = energy(softness);
  }
}

TEST_CASE("a volume mesh is the minimum for its own shapes, and its boundary moves the residual") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = shaken_cube(volumes);
    const auto form = std::make_shared<const VolumeWinslow>(
        form_of(mesh, TargetBlend::regular(), PenaltyOptions{}));
    const ShapePath<3> path(form, SpacePoints(mesh.coordinates), 1);
    CHECK(path.form_at(0)->residual(mesh.coordinates, {}).max < 1e-10);
    CHECK(path.form_at(0)->worst_distortion(mesh.coordinates) == doctest::Approx(1));
    CHECK(path.form_at(1) == form);
    CHECK(path.form_at(0.5)->worst_distortion(mesh.coordinates) <
          form->worst_distortion(mesh.coordinates));
    // -dR/db by differences.
    Random random(13);
    Coordinates displacement(3, mesh.topology->node_count());
    for (Index node = 0; node < displacement.size(); ++node) {
      if (!mesh.topology->on_boundary(node)) continue;
      displacement.set_xyz(
          node, Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    }
    std::vector<double> response(form->unknowns()), ahead(response), behind(response);
    form->boundary_response(mesh.coordinates, displacement, response);
    constexpr double h = 1e-6;
    const auto shifted = [&](double step) {
      Coordinates x = mesh.coordinates;
      for (std::size_t i = 0; i < x.values().size(); ++i)
        x.values()[i] += step * displacement.values()[i];
      return x;
    };
    form->residual(shifted(h), ahead);
    form->residual(shifted(-h), behind);
    double error = 0;
    for (std::size_t i = 0; i < response.size(); ++i) {
      const double difference = (ahead[i] - behind[i]) / (2 * h) - response[i];
      error += difference * difference;
    }
    CHECK(std::sqrt(error) < 1e-5 * std::sqrt(dot(response, response)));
  }
}

TEST_CASE("some target of a guarded element is inverted wherever its Jacobian is negative inside") {
  // The upper face of the middle cube is turned by half a turn and stretched on the way: the
  // Jacobian is a quadratic in z, that at the corners stays what it was.
  const Mesh mesh = make_mesh(cube(3, Volumes::hexahedra));
  const std::vector<Index> guarded{13};
  const auto element = mesh.topology->element(13);
  const auto turned_by = [&](double share) {
    const double a = M_PI * share, longer = std::exp(share);
    Coordinates x = mesh.coordinates;
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3 p(shape_of(ElementType::hexahedron).corners[k].data());
      Vec2 q = p.head<2>() - Vec2(0.5, 0.5);
      if (p.z() > 0.5) {
        const Vec2 u(longer * q.x(), q.y() / longer);
        q = Vec2(std::cos(a) * u.x() - std::sin(a) * u.y(),
                 std::sin(a) * u.x() + std::cos(a) * u.y());
      }
      x.set_xyz(element[k], {q.x(), q.y(), 2 * p.z()});
    }
    return x;
  };
  const auto targets = volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr, 1,
                                      {}, {nullptr, nullptr, guarded});
  std::vector<std::array<Index, 4>> own;
  double weight = 0;
  for (std::size_t cell = 0; cell < targets.cells.size(); ++cell) {
    const auto& nodes = targets.cells[cell];
    const bool inside = std::ranges::all_of(
        nodes, [&](Index node) { return std::ranges::find(element, node) != element.end(); });
    if (!inside) continue;
    own.push_back(nodes);
    weight += targets.terms[at(targets.offsets[cell])].weight;
  }
  CHECK(own.size() == 32);
  CHECK(weight == doctest::Approx(1));
  int inverted = 0;
  for (int step = 0; step <= 40; ++step) {
    const Coordinates x = turned_by(step / 40.0);
    CAPTURE(step);
    double corners = 1, all = 1;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const double d = VolumeCorner(SpacePoints(x), own[k]).determinant;
      all = std::min(all, d);
      if (k < 8) corners = std::min(corners, d);
    }
    CHECK(corners > 0);
    if (step <= 10) CHECK(all > 0);
    const VolumeElement shape(x, shape_of(ElementType::hexahedron), element);
    if (!shape.inverted()) continue;
    ++inverted;
    CHECK(all <= 0);
  }
  CHECK(inverted > 3);
}

TEST_CASE("derivatives with guarded elements") {
  for (const Volumes volumes : {Volumes::hexahedra, Volumes::prisms}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = shaken_cube(volumes);
    std::vector<Index> guarded;
    for (Index e = 0; e < mesh.topology->element_count(); e += 2) guarded.push_back(e);
    const VolumeWinslow form(free_interior(mesh.topology),
                             volume_targets(*mesh.topology, nullptr, TargetBlend::regular(),
                                            nullptr, 1, {}, {nullptr, nullptr, guarded}),
                             {8, 1.78}, 1);
    check_derivatives(form, mesh.coordinates);
  }
}
