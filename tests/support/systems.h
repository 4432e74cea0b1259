#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/formulation/stencil_operator.h"
#include "core/linear/linear_solver.h"
#include "core/mesh/mesh.h"
#include "support/random.h"

/// Linear systems for tests and benchmarks, and dense algebra to compare with.
namespace winslow::test {

using Dense = Eigen::MatrixXd;

/// About `per_row` blocks a row, not symmetric.
inline std::shared_ptr<const SparsityPattern> random_pattern(Random& random, Index n,
                                                             Index per_row) {
  auto pattern = std::make_shared<SparsityPattern>();
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> row{i};
    for (Index k = 0; k < per_row; ++k) row.push_back(random.index(n));
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    const auto diagonal = std::find(row.begin(), row.end(), i) - row.begin();
    pattern->diagonal.push_back(pattern->offsets.back() + static_cast<Index>(diagonal));
    pattern->columns.insert(pattern->columns.end(), row.begin(), row.end());
    pattern->offsets.push_back(static_cast<Index>(pattern->columns.size()));
  }
  return pattern;
}

inline void randomise_rhs(SparseSystem& system, Random& random) {
  system.rhs.resize(static_cast<std::size_t>(system.columns) *
                    static_cast<std::size_t>(system.matrix.rows()));
  for (double& b : system.rhs) b = random.uniform(-1, 1);
}

/// Values with a diagonal that outweighs the rest of its row, and right-hand sides.
inline void randomise(SparseSystem& system, Random& random) {
  SparseMatrix& a = system.matrix;
  const SparsityPattern& p = *a.pattern;
  const auto block = static_cast<std::size_t>(a.block);
  a.values.assign(p.columns.size() * block * block, 0.0);
  for (double& v : a.values) v = random.uniform(-1, 1);
  for (std::size_t i = 0; i + 1 < p.offsets.size(); ++i) {
    for (std::size_t r = 0; r < block; ++r) {
      double sum = 0;
      for (auto e = static_cast<std::size_t>(p.offsets[i]);
           e < static_cast<std::size_t>(p.offsets[i + 1]); ++e) {
        for (std::size_t c = 0; c < block; ++c) {
          sum += std::abs(a.values[(e * block + r) * block + c]);
        }
      }
      const auto d = static_cast<std::size_t>(p.diagonal[i]);
      a.values[(d * block + r) * block + r] = 1.1 * sum + 0.1;
    }
  }
  randomise_rhs(system, random);
}

inline SparseSystem random_system(Random& random, Index n, int columns = 2, int block = 1) {
  SparseSystem system;
  system.matrix.pattern = random_pattern(random, n, 6);
  system.matrix.block = block;
  system.columns = columns;
  randomise(system, random);
  return system;
}

/// Adds `sign` times the block to entry (row, column) of the matrix.
inline void add_block(SparseMatrix& a, Index row, Index column, const Dense& block) {
  const SparsityPattern& p = *a.pattern;
  const auto first = p.columns.begin() + p.offsets[static_cast<std::size_t>(row)];
  const auto last = p.columns.begin() + p.offsets[static_cast<std::size_t>(row) + 1];
  const auto e =
      static_cast<std::size_t>(std::lower_bound(first, last, column) - p.columns.begin());
  const auto size = static_cast<std::size_t>(a.block);
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t c = 0; c < size; ++c) {
      a.values[(e * size + r) * size + c] +=
          block(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    }
  }
}

/// Springs between the free nodes of a mesh, of random stiffness in every direction, and weak ones
/// that hold each node: symmetric positive definite, of any block size.
inline SparseSystem springs(const Mesh& mesh, Random& random, int block, double hold = 0.01,
                            int columns = 1) {
  SparseSystem system;
  SparseMatrix& a = system.matrix;
  a.pattern = NodePattern(*mesh.topology, mesh.topology->interior_nodes()).pattern;
  a.block = block;
  a.symmetric = true;
  a.values.assign(a.pattern->columns.size() * static_cast<std::size_t>(block * block), 0.0);
  for (Index i = 0; i < a.pattern->rows(); ++i) {
    add_block(a, i, i, hold * Dense::Identity(block, block));
    for (Index e = a.pattern->offsets[static_cast<std::size_t>(i)];
         e < a.pattern->offsets[static_cast<std::size_t>(i) + 1]; ++e) {
      const Index j = a.pattern->columns[static_cast<std::size_t>(e)];
      if (j <= i) continue;
      Dense root(block, block);
      for (double& v : root.reshaped()) v = random.uniform(-1, 1);
      Dense spring = root * root.transpose();
      spring = (0.5 * (spring + spring.transpose())).eval();
      add_block(a, i, i, spring);
      add_block(a, j, j, spring);
      add_block(a, i, j, -spring);
      add_block(a, j, i, -spring);
    }
  }
  system.columns = columns;
  randomise_rhs(system, random);
  return system;
}

/// Plane linear elasticity on the triangles of a mesh with its boundary held, Lame's parameters
/// lambda and 1: close to the Hessian of the mesh energies. 2 by 2 blocks, right-hand side random.
inline SparseSystem elasticity(const Mesh& mesh, double lambda = 2) {
  const Topology& topology = *mesh.topology;
  const NodePattern free(topology, topology.interior_nodes());
  SparseSystem system;
  SparseMatrix& a = system.matrix;
  a.pattern = free.pattern;
  a.block = 2;
  a.symmetric = true;
  a.values.assign(4 * a.pattern->columns.size(), 0.0);
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto nodes = topology.element(e);
    Vec2 opposite[3];  // gradients of the shape functions, times twice the area
    const auto x = [&](std::size_t k) { return mesh.coordinates.xy(nodes[k % 3]); };
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = x(k + 2) - x(k + 1);
      opposite[k] = Vec2(-side.y(), side.x());
    }
    const Vec2 u = x(1) - x(0), v = x(2) - x(0);
    const double factor = 1 / (2 * std::abs(u.x() * v.y() - u.y() * v.x()));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const Index row = free.row_of_node[static_cast<std::size_t>(nodes[i])];
        const Index column = free.row_of_node[static_cast<std::size_t>(nodes[j])];
        if (row < 0 || column < 0) continue;
        const Vec2 &g = opposite[i], &h = opposite[j];
        add_block(a, row, column,
                  factor * (lambda * g * h.transpose() + h * g.transpose() +
                            g.dot(h) * Eigen::Matrix2d::Identity()));
      }
    }
  }
  Random random(5);
  randomise_rhs(system, random);
  return system;
}

inline Dense dense_matrix(const SparseMatrix& matrix) {
  Dense a = Dense::Zero(matrix.rows(), matrix.rows());
  const Index block = matrix.block;
  for (Index i = 0; i < matrix.pattern->rows(); ++i) {
    for (Index e = matrix.pattern->offsets[static_cast<std::size_t>(i)];
         e < matrix.pattern->offsets[static_cast<std::size_t>(i) + 1]; ++e) {
      const Index j = matrix.pattern->columns[static_cast<std::size_t>(e)];
      for (Index r = 0; r < block; ++r) {
        for (Index c = 0; c < block; ++c) {
          a(i * block + r, j * block + c) =
              matrix.values[static_cast<std::size_t>((e * block + r) * block + c)];
        }
      }
    }
  }
  return a;
}

/// Right-hand sides or solutions as a matrix, one in each column.
inline Dense as_matrix(const SparseSystem& system, std::span<const double> x) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(x.data(), system.matrix.rows(), system.columns);
}

inline Dense dense_solution(const SparseSystem& system) {
  return dense_matrix(system.matrix).partialPivLu().solve(as_matrix(system, system.rhs));
}

inline double dense_relative_residual(const SparseSystem& system, std::span<const double> x) {
  const Dense b = as_matrix(system, system.rhs);
  const Dense defect = b - dense_matrix(system.matrix) * as_matrix(system, x);
  double worst = 0;
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    worst = std::max(worst, defect.col(c).norm() / b.col(c).norm());
  }
  return worst;
}

inline LinearResult solve(LinearSolver& solver, const SparseSystem& system, std::span<double> x) {
  solver.set_matrix(system.matrix);
  return solver.solve(system.rhs, system.columns, x);
}

/// Names of the solvers that take matrices of any kind.
inline std::vector<std::string> general_solver_names() {
  std::vector<std::string> names;
  for (const std::string& name : linear_solver_names()) {
    if (!linear_solver_needs_symmetry(name)) names.push_back(name);
  }
  return names;
}

/// Options for a solver to go to the limits of double precision.
inline LinearOptions tight_linear(const std::string& name) {
  LinearOptions options;
  options.solver = name;
  options.tolerance = 1e-12;
  options.max_iterations = 2000;
  return options;
}

}  // namespace winslow::test
