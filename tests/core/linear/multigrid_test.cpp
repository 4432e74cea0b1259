#include "core/linear/multigrid.h"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/linear/linear_solver.h"
#include "core/linear/preconditioner.h"
#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The mesh with its nodes numbered at random, stretched in y.
Mesh shuffled(MeshData data, double stretch, std::uint64_t seed) {
  Random random(seed);
  const std::vector<Index> place = random.permutation(data.node_count());
  MeshData result = data;
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    result.coordinates.set_xy(place[at(i)], {p.x(), stretch * p.y()});
  }
  for (Index& node : result.element_nodes) node = place[at(node)];
  for (auto& marker : result.markers) {
    for (Face& edge : marker.faces) edge = by_nodes(edge, place);
  }
  return make_mesh(std::move(result));
}

Dense applied_to_unit_vectors(Preconditioner& m, Index n) {
  Dense result(n, n);
  std::vector<double> r(at(n), 0.0), z(at(n));
  for (Index k = 0; k < n; ++k) {
    r[at(k)] = 1;
    m.apply(r, z);
    for (Index i = 0; i < n; ++i) result(i, k) = z[at(i)];
    r[at(k)] = 0;
  }
  return result;
}

LinearResult iterations_on(const SparseSystem& system, const std::string& name, int threads = 0) {
  LinearOptions options;
  options.solver = name;
  options.tolerance = 1e-6;
  options.max_iterations = 2000;
  std::vector<double> x(system.rhs.size(), 0.0);
  const auto solver = make_linear_solver(options, threads);
  return solve(*solver, system, x);
}

}  // namespace

TEST_CASE("the preconditioners for conjugate gradients are symmetric and positive definite") {
  Random random(1);
  const Mesh mesh = make_mesh(square_with_hole(15, Cells::triangles));
  for (const int block : {1, 2, 3}) {
    for (const bool elastic : {false, true}) {
      if (elastic && block != 2) continue;
      const SparseSystem system = elastic ? elasticity(mesh) : springs(mesh, random, block);
      for (auto make : {make_multigrid, make_incomplete_cholesky}) {
        const auto preconditioner = make(1);
        CAPTURE(block);
        CAPTURE(preconditioner->description());
        preconditioner->build(system.matrix);
        const Dense m = applied_to_unit_vectors(*preconditioner, system.matrix.rows());
        CHECK((m - m.transpose()).norm() < 1e-5 * m.norm());
        // The eigenvalues of M^-1 A are those of L^T M^-1 L with A = L L^T.
        const Dense l = dense_matrix(system.matrix).llt().matrixL();
        Dense product = l.transpose() * m * l;
        product = (0.5 * (product + product.transpose())).eval();
        const Eigen::VectorXd spectrum =
            Eigen::SelfAdjointEigenSolver<Dense>(product).eigenvalues();
        CHECK(spectrum[0] > 0.001);
        // The cycle never overshoots: its smoother and its coarse level are contractions.
        if (preconditioner->description().starts_with("smoothed")) {
          CHECK(spectrum[spectrum.size() - 1] < 1 + 1e-4);
        }
      }
    }
  }
}

TEST_CASE("iterations of multigrid hardly depend on the number of unknowns") {
  for (const double stretch : {1.0, 0.02}) {
    CAPTURE(stretch);
    std::vector<int> iterations;
    for (const Index n : {50, 100, 200}) {
      const SparseSystem system =
          elasticity(shuffled(square(n, Cells::triangles), stretch, static_cast<unsigned>(n)));
      const LinearResult result = iterations_on(system, "multigrid");
      CHECK(result.relative_residual <= 2e-6);
      iterations.push_back(result.iterations);
    }
    CAPTURE(iterations[0]);
    CAPTURE(iterations[1]);
    CAPTURE(iterations[2]);
    CHECK(iterations[2] <= 40);
    // Stretched, the short meshes are all but one-dimensional: easier than they will be.
    if (stretch == 1) CHECK(iterations[2] <= 1.4 * iterations[0]);
  }
}

TEST_CASE("multigrid copes with cells that grow a thousandfold") {
  const Mesh mesh = make_mesh(annulus(64, 80, std::pow(1e4, 1.0 / 80), Cells::triangles));
  CHECK(iterations_on(elasticity(mesh), "multigrid").iterations <= 40);
}

TEST_CASE("multigrid and incomplete Cholesky are the same bit for bit at any number of threads") {
  // More rows than one run has, on two levels.
  const SparseSystem system = elasticity(shuffled(square(220, Cells::triangles), 0.3, 29));
  REQUIRE(system.matrix.pattern->rows() > 40'000);
  for (const std::string name : {"cg", "multigrid"}) {
    CAPTURE(name);
    LinearOptions options;
    options.solver = name;
    options.max_iterations = 40;
    options.tolerance = 1e-8;
    std::vector<double> reference;
    for (const int threads : {1, 2, 4}) {
      CAPTURE(threads);
      std::vector<double> x(system.rhs.size(), 0.0);
      const auto solver = make_linear_solver(options, threads);
      for (int round = 0; round < 2; ++round) {
        std::fill(x.begin(), x.end(), 0.0);
        solve(*solver, system, x);
      }
      if (reference.empty()) reference = x;
      CHECK(x == reference);
    }
  }
}

TEST_CASE("multigrid on a matrix without connections, and with rows apart") {
  // No entry off the diagonal is strong: the smoother alone is left.
  Random random(31);
  SparseSystem system = springs(make_mesh(square(40, Cells::triangles)), random, 2, 1e3);
  CHECK(iterations_on(system, "multigrid").relative_residual <= 2e-6);
  // Every second row is left alone.
  system = springs(make_mesh(square(40, Cells::triangles)), random, 2, 0.1);
  const SparsityPattern& p = *system.matrix.pattern;
  for (Index i = 0; i < p.rows(); ++i) {
    for (Index e = p.offsets[at(i)]; e < p.offsets[at(i) + 1]; ++e) {
      const Index j = p.columns[at(e)];
      if (i == j || (i % 2 == 1 && j % 2 == 1)) continue;
      std::fill_n(&system.matrix.values[4 * at(e)], 4, 0.0);
    }
  }
  CHECK(iterations_on(system, "multigrid").relative_residual <= 2e-6);
}

TEST_CASE("numbers far from one do not leave the range of single precision") {
  for (const double unit : {1e-30, 1e30}) {
    SparseSystem system = elasticity(make_mesh(square(40, Cells::triangles)));
    const int expected = iterations_on(system, "multigrid").iterations;
    for (double& b : system.rhs) b *= unit;
    CHECK(iterations_on(system, "multigrid").iterations == expected);
  }
}
