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

TEST_CASE("the sweeps of Gauss-Seidel are those of the dense matrix") {
  Random random(2);
  const Mesh mesh = make_mesh(square_with_hole(12, Cells::triangles));
  for (const auto& shape : {std::pair{1, 1}, {1, 4}, {2, 1}, {3, 1}}) {
    const int block = shape.first, width = shape.second;
    CAPTURE(block);
    CAPTURE(width);
    const SparseSystem system = springs(mesh, random, block, 0.1);
    GaussSeidel smoother;
    smoother.build(system.matrix, 1, width);
    const Dense a = dense_matrix(system.matrix);
    Dense m = a;  // all rows are in one run
    for (Index i = 0; i < a.rows(); ++i)
      for (Index j = 0; j < a.cols(); ++j)
        if (j / block > i / block) m(i, j) = 0;
    const std::size_t stride = at(row_stride(block, width));
    const auto rows = at(system.matrix.pattern->rows());
    std::vector<Real> b(stride * rows), x(b), r(b);
    for (Real& v : b) v = static_cast<Real>(random.uniform(-1, 1));
    // Column k of a vector: its numbers in the block, or right-hand side k.
    const auto column = [&](const std::vector<Real>& v, int side) {
      Eigen::VectorXd out(a.rows());
      for (Index i = 0; i < a.rows(); ++i)
        out[i] = static_cast<double>(v[stride * at(i / block) + at(i % block + side)]);
      return out;
    };
    smoother.forward(b, x, r, 1);
    for (int side = 0; side < width; ++side) {
      const Eigen::VectorXd expected = m.partialPivLu().solve(column(b, side));
      CHECK((column(x, side) - expected).norm() < 1e-5 * expected.norm());
      const Eigen::VectorXd rest = column(b, side) - a * expected;
      CHECK((column(r, side) - rest).norm() < 1e-5 * column(b, side).norm());
    }
    for (Real& v : x) v = static_cast<Real>(random.uniform(-1, 1));
    const std::vector<Real> before = x;
    smoother.defect(b, x, r, 1);
    smoother.backward(b, before, x, 1);
    for (int side = 0; side < width; ++side) {
      const Eigen::VectorXd rest = column(b, side) - a * column(before, side);
      CHECK((column(r, side) - rest).norm() < 1e-5 * rest.norm());
      const Eigen::VectorXd expected =
          column(before, side) + m.transpose().partialPivLu().solve(rest);
      CHECK((column(x, side) - expected).norm() < 1e-5 * expected.norm());
    }
  }
}

TEST_CASE("the defect after a forward sweep is right between runs, too") {
  Random random(3);
  const Mesh mesh = make_mesh(square(80, Cells::triangles));
  for (const auto& shape : {std::pair{1, 1}, {1, 4}, {2, 1}, {3, 1}}) {
    const int block = shape.first, width = shape.second;
    CAPTURE(block);
    CAPTURE(width);
    // Strong connections between runs: the sweep is damped there.
    const SparseSystem system = springs(mesh, random, block, 1e-3);
    REQUIRE(system.matrix.pattern->rows() > 4096);
    std::vector<Real> single;
    for (const int threads : {1, 2}) {
      GaussSeidel smoother;
      smoother.build(system.matrix, threads, width);
      std::vector<Real> b(at(row_stride(block, width)) * at(system.matrix.pattern->rows())), x(b),
          r(b), defect(b);
      for (std::size_t i = 0; i < b.size(); ++i)
        b[i] = static_cast<Real>(std::sin(1.0 + 3.7 * double(i)));
      smoother.forward(b, x, r, threads);
      smoother.defect(b, x, defect, threads);
      for (std::size_t i = 0; i < r.size(); ++i) {
        if (block == 3 && i % 4 == 3) continue;
        CHECK(static_cast<double>(r[i]) ==
              doctest::Approx(static_cast<double>(defect[i])).epsilon(1e-4).scale(1));
      }
      if (single.empty()) single = x;
      CHECK(x == single);
    }
  }
}

TEST_CASE("multigrid of components gives what multigrid gives for each") {
  Random random(4);
  const SparseSystem system = springs(make_mesh(square(60, Cells::triangles)), random, 1, 0.1);
  const auto n = at(system.matrix.rows());
  const auto together = make_multigrid_of_components(2), alone = make_multigrid(2);
  together->build(system.matrix);
  alone->build(system.matrix);
  std::vector<double> r(3 * n), z(r), one(n), expected(n);
  for (double& v : r) v = random.uniform(-1, 1);
  together->apply(r, z);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < n; ++i) one[i] = r[3 * i + k];
    alone->apply(one, expected);
    for (std::size_t i = 0; i < n; ++i) one[i] = z[3 * i + k];
    CHECK(one == expected);
  }
  // Three right-hand sides cost less than three times one: the matrix is read once.
  CHECK(together->work().flops == doctest::Approx(3 * alone->work().flops));
  CHECK(together->work().bytes < 2.5 * alone->work().bytes);
  CHECK(alone->work().bytes > 2 * 8.0 * static_cast<double>(system.matrix.pattern->columns.size()));
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
