#include "core/formulation/kept_shapes.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"
#include "core/formulation/simplex_kernel.h"
#include "core/formulation/surface_winslow.h"
#include "core/formulation/target_path.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/quality/quality.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A guard of 1 makes errors of its part visible.
const PenaltyOptions strong{.guard = 1};

std::shared_ptr<const VariationalForm> keeping(const Mesh& mesh,
                                               const PenaltyOptions& penalty = strong) {
  const auto classes = free_interior(mesh.topology);
  if (mesh.topology->cell_dimension() == 3)
    return std::make_shared<const VolumeWinslow>(
        classes,
        volume_targets(*mesh.topology, nullptr, TargetBlend::keeping(), &mesh.coordinates, 1),
        penalty, 1);
  const VirtualControlVolumes vcv(mesh.topology);
  return std::make_shared<const VariationalWinslow>(
      classes, TargetShapes::build(vcv, TargetBlend::keeping(), &mesh.coordinates), penalty, 1);
}

std::vector<Mesh> samples() {
  std::vector<Mesh> meshes;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed})
    meshes.push_back(make_mesh(square_with_hole(10, cells)));
  for (const Volumes volumes : all_volumes) meshes.push_back(make_mesh(cube(3, volumes)));
  return meshes;
}

/// Moves every interior node at random, by at most a share of the size of the mesh, and less where
/// that would invert elements.
Coordinates shaken(const Mesh& mesh, double share, std::uint64_t seed) {
  for (double by = share;; by /= 2) {
    Random random(seed);
    Coordinates x = mesh.coordinates;
    for (const Index node : mesh.topology->interior_nodes()) {
      Vec3 move(0, 0, 0);
      for (double& c : move.head(x.dimension())) c = random.uniform(-by, by);
      set_place(x, node, place_of(x, node) + move);
    }
    if (check_validity(*mesh.topology, x, 1).inverted == 0) return x;
  }
}

std::vector<double> product(const SparseMatrix& matrix, const std::vector<double>& v) {
  const auto n = at(matrix.block);
  std::vector<double> out(v.size(), 0.0);
  for (std::size_t row = 0; row + 1 < matrix.pattern->offsets.size(); ++row)
    for (auto e = at(matrix.pattern->offsets[row]); e < at(matrix.pattern->offsets[row + 1]); ++e)
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = 0; c < n; ++c)
          out[n * row + r] +=
              matrix.values[n * n * e + n * r + c] * v[n * at(matrix.pattern->columns[e]) + c];
  return out;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double a : v) sum += a * a;
  return std::sqrt(sum);
}

/// psi of a guard by its definition.
double guard(double r, double p) {
  constexpr double steepest = 2;
  if (r <= 1) return 0;
  if (r <= steepest) return std::pow(r, p) - 1 - p * (r - 1) - p * (p - 1) / 2 * (r - 1) * (r - 1);
  const double slope = p * (std::pow(steepest, p - 1) - 1 - (p - 1) * (steepest - 1));
  return guard(steepest, p) + slope * (r - steepest);
}

}  // namespace

TEST_CASE("keep: derivatives agree with differences, with guards in effect") {
  for (const Mesh& mesh : samples()) {
    for (const PenaltyOptions& penalty :
         {PenaltyOptions{.guard = 1}, PenaltyOptions{.exponent = 4.5, .guard = 10},
          PenaltyOptions{.exponent = 8, .raise = 1.02, .guard = 3},
          PenaltyOptions{.exponent = 2}}) {
      CAPTURE(mesh.coordinates.dimension());
      CAPTURE(penalty.exponent);
      const auto form = keeping(mesh, penalty);
      const Coordinates x = shaken(mesh, 0.2, 5);
      if (penalty.exponent > 2) CHECK(form->strain(x, penalty.knee) > 1.01 * penalty.raise);
      Random random(3);
      std::vector<double> rates(form->unknowns());
      for (double& rate : rates) rate = random.uniform(-1, 1);
      const auto moved = [&](double step) {
        Coordinates there = x;
        form->advance(rates, step, there);
        return there;
      };
      constexpr double h = 1e-6;
      std::vector<double> residual(rates.size()), ahead(rates.size()), behind(rates.size());
      SparseMatrix hessian;
      const Linearisation at_x = form->linearise(x, Curvature::exact, hessian, residual);
      CHECK(at_x.energy == doctest::Approx(form->energy(x)).epsilon(1e-12));
      double slope = 0;
      for (std::size_t i = 0; i < rates.size(); ++i) slope -= residual[i] * rates[i];
      const double difference = (form->energy(moved(h)) - form->energy(moved(-h))) / (2 * h);
      CHECK(std::abs(slope - difference) <= 1e-6 * (std::abs(slope) + norm(residual)));
      form->residual(moved(h), ahead);
      form->residual(moved(-h), behind);
      std::vector<double> error = product(hessian, rates);
      const double size = norm(error);
      for (std::size_t i = 0; i < error.size(); ++i) error[i] += (ahead[i] - behind[i]) / (2 * h);
      CHECK(norm(error) <= 2e-6 * size);
      // The projected Hessian has no negative curvature, and is never below the exact one.
      SparseMatrix projected;
      form->linearise(x, Curvature::projected, projected, residual);
      for (int k = 0; k < 5; ++k) {
        for (double& rate : rates) rate = random.uniform(-1, 1);
        const auto exact = product(hessian, rates), convex = product(projected, rates);
        double a = 0, b = 0;
        for (std::size_t i = 0; i < rates.size(); ++i) {
          a += rates[i] * exact[i];
          b += rates[i] * convex[i];
        }
        CHECK(b > 0);
        CHECK(b >= a - 1e-9 * std::abs(a));
      }
    }
  }
}

TEST_CASE("keep: a mesh is its own solution, turned and scaled as well") {
  for (const Mesh& regular : samples()) {
    CAPTURE(regular.coordinates.dimension());
    Mesh mesh = regular;
    mesh.coordinates = shaken(regular, 0.05, 7);
    const auto form = keeping(mesh);
    const double energy = form->energy(mesh.coordinates);
    CHECK(form->residual(mesh.coordinates, {}).max < 1e-12);
    CHECK(form->strain(mesh.coordinates, 1.78) <= 1 + 1e-12);
    CHECK(form->worst_distortion(mesh.coordinates) == doctest::Approx(1));
    Coordinates turned = mesh.coordinates;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3::UnitZ()).toRotationMatrix();
    for (Index node = 0; node < turned.size(); ++node)
      set_place(turned, node, 3 * (turn * place_of(turned, node)) + Vec3(1, 2, 0));
    CHECK(form->residual(turned, {}).max < 1e-11);
    CHECK(form->energy(turned) == doctest::Approx(energy).epsilon(1e-12));
    // Any other mesh has more energy.
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      Mesh copy = mesh;
      CHECK(form->energy(shaken(copy, 0.02, seed)) > energy);
    }
  }
}

TEST_CASE("keep: the energy of one triangle is that of its definition") {
  const TargetMetric regular = TargetMetric::of_angle(pi / 3);
  Random random(4);
  for (int sample = 0; sample < 50; ++sample) {
    const auto shape = [&] {
      return std::array<Vec2, 2>{Vec2(random.uniform(0.5, 3), random.uniform(-0.4, 0.4)),
                                 Vec2(random.uniform(-1, 1), random.uniform(0.3, 1))};
    };
    const auto own = shape(), now = shape();
    const auto columns = [](const std::array<Vec2, 2>& edges) {
      Eigen::Matrix2d m;
      m << edges[0], edges[1];
      return m;
    };
    Eigen::Matrix2d equilateral;
    equilateral << 1, 0.5, 0, std::sqrt(3.0) / 2;
    const auto f = [&](const Eigen::Matrix2d& from, const Eigen::Matrix2d& to) {
      const Eigen::Matrix2d j = to * from.inverse();
      return j.squaredNorm() / (2 * j.determinant());
    };
    const double given = f(equilateral, columns(own)), seen = f(equilateral, columns(now));
    const double aspect = std::exp(stretch_between(regular, TargetMetric::of<2>(own[0], own[1])));
    const double weight = 0.7 * std::clamp(aspect / 4, 1.0, 300.0);
    const double weight_of_guard =
        weight * std::min(100.0, std::pow(std::max(1.0, given / 1.5), 8));
    const double expected = weight * f(columns(own), columns(now)) +
                            0.1 * weight_of_guard * guard(seen / std::max(1.4, given), 8);
    CellTargets<2> targets;
    targets.cells = {{0, 1, 2}};
    append(targets, kept_terms(shape_of(ElementType::triangle), regular,
                               TargetMetric::of<2>(own[0], own[1]), 0.7));
    const std::array<double, 6> x{0, 0, now[0].x(), now[0].y(), now[1].x(), now[1].y()};
    const std::array<Index, 2> offsets{0, 2};
    distortion::SimplexData data;
    data.x = x.data();
    data.nodes = targets.cells[0].data();
    data.offsets = offsets.data();
    data.terms = &targets.terms[0].ab;
    data.inverse_limits = targets.inverse_limits.data();
    data.penalty = distortion::PenaltyFunction(PenaltyOptions{}, true).constants();
    CHECK(distortion::fastest_kernel<2>().energy(data, 0, 1) ==
          doctest::Approx(expected).epsilon(1e-10));
  }
}

TEST_CASE("keep: elements count as much as the simplices that fill them") {
  // Volumes over those of a regular tetrahedron with the same edges: cube 1, prism sqrt(3) / 4,
  // pyramid sqrt(2) / 6, tetrahedron sqrt(2) / 12.
  const double tetrahedron = std::sqrt(2.0) / 12;
  const auto weight = [](ElementType type) {
    const Eigen::Matrix3d& regular = regular_metrics(type)[0];
    return kept_terms(shape_of(type), regular, regular, 1).own.weight;
  };
  CHECK(weight(ElementType::tetrahedron) == 1);
  CHECK(weight(ElementType::hexahedron) == doctest::Approx(1 / tetrahedron));
  CHECK(weight(ElementType::prism) == doctest::Approx(std::sqrt(3.0) / 4 / tetrahedron));
  CHECK(weight(ElementType::pyramid) == doctest::Approx(std::sqrt(2.0) / 6 / tetrahedron));
  const auto flat = TargetMetric::of_angle(pi / 2);
  CHECK(kept_terms(shape_of(ElementType::quadrilateral), flat, flat, 1).own.weight ==
        doctest::Approx(4 / std::sqrt(3.0)));
}

TEST_CASE("keep: both versions of the loops give the same bits") {
  const auto check = [&]<int D>(const CellTargets<D>& targets, const Coordinates& x) {
    const distortion::SimplexKernel<D>* fast = distortion::avx2_kernel<D>();
    if (!fast) return;
    constexpr auto size = distortion::SimplexLayout<D>::sum;
    const auto count = static_cast<Index>(targets.cells.size());
    std::vector<Index> list;
    for (Index i = 0; i < count; ++i) list.push_back(count - 1 - i);
    distortion::SimplexData data;
    data.x = x.values().data();
    data.nodes = targets.cells.front().data();
    data.offsets = targets.offsets.data();
    data.terms = reinterpret_cast<const double*>(targets.terms.data());
    data.inverse_limits = targets.inverse_limits.data();
    for (const double exponent : {8.0, 4.5}) {
      data.penalty =
          distortion::PenaltyFunction({.exponent = exponent, .guard = 5}, true).constants();
      std::vector<double> a(at(size) * (targets.cells.size() + 3)), b(a);
      const auto& portable = distortion::portable_kernel<D>();
      CHECK(portable.energy(data, 0, count) == fast->energy(data, 0, count));
      CHECK(portable.sum(data, list.data(), count, 0, a.data()) ==
            fast->sum(data, list.data(), count, 0, b.data()));
      a.resize(at(size) * targets.cells.size());
      b.resize(a.size());
      CHECK(a == b);
    }
  };
  for (const Mesh& mesh : samples()) {
    const Coordinates x = shaken(mesh, 0.1, 2);
    if (mesh.topology->cell_dimension() == 2)
      check(static_cast<const CellTargets<2>&>(TargetShapes::build(
                VirtualControlVolumes(mesh.topology), TargetBlend::keeping(), &mesh.coordinates)),
            x);
    else
      check(volume_targets(*mesh.topology, nullptr, TargetBlend::keeping(), &mesh.coordinates, 1),
            x);
  }
}

TEST_CASE("keep: elements without a shape of their own are regular, and counted") {
  const auto last_of = [](const CellTargets<3>& targets) { return targets.without_shape; };
  Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  CHECK(last_of(volume_targets(*mesh.topology, nullptr, TargetBlend::keeping(), &mesh.coordinates,
                               1)) == 0);
  // One node across the opposite face of one of its elements.
  const Index node = mesh.topology->interior_nodes()[5];
  const Index e = mesh.topology->star(node)[0];
  Vec3 centre(0, 0, 0);
  for (const Index other : mesh.topology->element(e))
    if (other != node) centre += mesh.coordinates.xyz(other) / 3;
  mesh.coordinates.set_xyz(node, 2.05 * centre - 1.05 * mesh.coordinates.xyz(node));
  const Index inverted = check_validity(*mesh.topology, mesh.coordinates, 1).inverted;
  REQUIRE(inverted > 0);
  REQUIRE(20 * inverted < mesh.topology->element_count());
  const auto targets =
      volume_targets(*mesh.topology, nullptr, TargetBlend::keeping(), &mesh.coordinates, 1);
  CHECK(targets.without_shape == inverted);
  const Eigen::Matrix3d& regular = regular_metrics(ElementType::tetrahedron)[0];
  Index as_regular = 0;
  for (std::size_t t = 0; t < targets.cells.size(); ++t)
    as_regular += (metric_of(targets.terms_of(t)[0]) - regular).norm() < 1e-12 ? 1 : 0;
  CHECK(as_regular == inverted);
  // A tangled mesh has no shape to keep.
  Random random(1);
  for (const Index free : mesh.topology->interior_nodes())
    mesh.coordinates.set_xyz(free, Vec3(random.uniform(0, 1), random.uniform(0, 1), 0.5));
  const auto of_tangle =
      volume_targets(*mesh.topology, nullptr, TargetBlend::keeping(), &mesh.coordinates, 1);
  for (std::size_t t = 0; t < of_tangle.cells.size(); ++t)
    CHECK((metric_of(of_tangle.terms_of(t)[0]) - regular).norm() < 1e-12);
}

TEST_CASE("keep: a path of targets begins at any valid mesh") {
  for (const Mesh& mesh : samples()) {
    const auto form = keeping(mesh);
    const Coordinates x = shaken(mesh, 0.1, 9);
    const auto path = form->target_path(x);
    CHECK(path->at_share(0)->residual(x, {}).max < 1e-11);
    CHECK(path->at_share(1)->energy(x) == doctest::Approx(form->energy(x)));
    CHECK(path->at_share(0.5)->energy(x) < form->energy(x));
  }
}

TEST_CASE("keep: is not blended with other shapes") {
  const Mesh mesh = make_mesh(square(4, Cells::quads));
  const VirtualControlVolumes vcv(mesh.topology);
  CHECK_THROWS_WITH_AS(TargetShapes::build(vcv, {.rest = 1, .keep = 1}, &mesh.coordinates),
                       "targets: keep cannot be blended with other shapes: give it alone, or blend "
                       "rest instead",
                       UsageError);
  CHECK(TargetBlend{}.by_command());
  CHECK(TargetBlend{}.or_else(TargetBlend::keeping()) == TargetBlend::keeping());
  CHECK(TargetBlend::regular().or_else(TargetBlend::keeping()) == TargetBlend::regular());
}
