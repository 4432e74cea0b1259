#include "core/linear/smoothed_aggregation.h"

#include <doctest/doctest.h>

#include <set>

#include "core/formulation/stencil_operator.h"
#include "core/linear/preconditioner.h"
#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

SparsityPattern pattern_of(Index n) {
  const auto topology = Topology::build(square_with_hole(n, Cells::triangles));
  return *NodePattern(*topology, topology->interior_nodes()).pattern;
}

}  // namespace

TEST_CASE("aggregates are connected patches that leave nobody out") {
  const SparsityPattern graph = pattern_of(40);
  const Aggregates aggregates = aggregate(graph);
  REQUIRE(aggregates.of_row.size() == at(graph.rows()));
  std::vector<std::vector<Index>> members(at(aggregates.count));
  for (Index i = 0; i < graph.rows(); ++i) {
    REQUIRE(aggregates.of_row[at(i)] >= 0);
    REQUIRE(aggregates.of_row[at(i)] < aggregates.count);
    members[at(aggregates.of_row[at(i)])].push_back(i);
  }
  CHECK(aggregates.count < graph.rows() / 5);
  for (const auto& patch : members) {
    REQUIRE(!patch.empty());
    std::set<Index> reached{patch[0]};
    std::vector<Index> front{patch[0]};
    while (!front.empty()) {
      const Index i = front.back();
      front.pop_back();
      for (Index e = graph.offsets[at(i)]; e < graph.offsets[at(i) + 1]; ++e) {
        const Index j = graph.columns[at(e)];
        if (aggregates.of_row[at(j)] == aggregates.of_row[at(i)] && reached.insert(j).second) {
          front.push_back(j);
        }
      }
    }
    CHECK(reached.size() == patch.size());
  }
}

TEST_CASE("weak connections do not aggregate") {
  const SparsityPattern graph = pattern_of(20);
  const std::vector<char> none(graph.columns.size(), 0);
  const Aggregates apart = aggregate(graph, none);
  CHECK(apart.count == 0);
  for (const Index a : apart.of_row) CHECK(a == -1);
  // Connections between rows of the same parity only.
  std::vector<char> parity(graph.columns.size());
  for (Index i = 0; i < graph.rows(); ++i) {
    for (Index e = graph.offsets[at(i)]; e < graph.offsets[at(i) + 1]; ++e) {
      parity[at(e)] = (graph.columns[at(e)] - i) % 2 == 0;
    }
  }
  const Aggregates split = aggregate(graph, parity);
  std::vector<int> parity_of(at(split.count), -1);
  for (Index i = 0; i < graph.rows(); ++i) {
    const Index a = split.of_row[at(i)];
    if (a < 0) continue;
    if (parity_of[at(a)] < 0) parity_of[at(a)] = i % 2;
    CHECK(parity_of[at(a)] == i % 2);
  }
}

TEST_CASE("the locality ordering is a permutation that brings neighbours together") {
  const SparsityPattern graph = pattern_of(100);
  const std::vector<Index> order = locality_ordering(graph);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (Index i = 0; i < graph.rows(); ++i) REQUIRE(sorted[at(i)] == i);
  // Of the connections within runs of 256 rows, how many stay inside? A patch of 256 nodes has some
  // 60 at its rim.
  std::vector<Index> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[at(order[k])] = static_cast<Index>(k);
  Index inside = 0, all = 0;
  for (Index i = 0; i < graph.rows(); ++i) {
    for (Index e = graph.offsets[at(i)]; e < graph.offsets[at(i) + 1]; ++e) {
      const Index j = graph.columns[at(e)];
      inside += place[at(i)] / 256 == place[at(j)] / 256;
      ++all;
    }
  }
  CHECK(inside > 0.7 * all);
  CHECK(locality_ordering(SparsityPattern{}).empty());
}

TEST_CASE("a reordered matrix is the same operator") {
  Random random(3);
  const SparseSystem system = springs(make_mesh(square(12, Cells::triangles)), random, 2, 0.1, 3);
  ReorderedMatrix reordered;
  for (int round = 0; round < 2; ++round) {
    reordered.assign(system.matrix, 2);
    const SparseMatrix& b = reordered.matrix();
    for (std::size_t i = 0; i < at(b.pattern->rows()); ++i) {
      CHECK(b.pattern->columns[at(b.pattern->diagonal[i])] == static_cast<Index>(i));
    }
    const auto n = at(b.rows());
    std::vector<double> x(n), y(3 * n, 0.0);
    for (int c = 0; c < 3; ++c) {
      reordered.gather(system.rhs, 3, c, x);
      const Eigen::VectorXd product =
          dense_matrix(b) * Eigen::Map<const Eigen::VectorXd>(x.data(), b.rows());
      reordered.scatter(std::span(product.data(), n), 3, c, y);
    }
    const Dense expected = dense_matrix(system.matrix) * as_matrix(system, system.rhs);
    CHECK((as_matrix(system, y) - expected).norm() < 1e-13 * expected.norm());
  }
}

namespace {

/// The numbers of a dense vector in the rows of a vector of multigrid.
std::vector<Real> in_rows(const Eigen::VectorXd& v, int block) {
  const std::size_t stride = at(row_stride(block, 1)), size = at(block);
  std::vector<Real> out(stride * (static_cast<std::size_t>(v.size()) / size), Real{0});
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out[stride * (k / size) + k % size] = static_cast<Real>(v[i]);
  }
  return out;
}
Eigen::VectorXd out_of_rows(const std::vector<Real>& rows, int block) {
  const std::size_t stride = at(row_stride(block, 1)), size = at(block);
  Eigen::VectorXd out(static_cast<Eigen::Index>(rows.size() / stride * size));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out[i] = static_cast<double>(rows[stride * (k / size) + k % size]);
  }
  return out;
}

/// An interpolation as a dense matrix, column by column.
Dense dense_of(const Prolongation& prolongation, const SparseMatrix& matrix) {
  const Index coarse = prolongation.coarse_rows() * matrix.block;
  Dense result(matrix.rows(), coarse);
  for (Index c = 0; c < coarse; ++c) {
    std::vector<Real> x = in_rows(Eigen::VectorXd::Zero(matrix.rows()), matrix.block), copy(x);
    prolongation.prolong(in_rows(Eigen::VectorXd::Unit(coarse, c), matrix.block), x, copy, 1);
    CHECK(copy == x);
    result.col(c) = out_of_rows(x, matrix.block);
  }
  return result;
}

}  // namespace

TEST_CASE("restriction is the transposed interpolation, and the coarse matrix their product") {
  Random random(7);
  // More aggregates than are treated in one block.
  const Mesh mesh = make_mesh(square_with_hole(56, Cells::triangles));
  for (const int block : {1, 2, 3}) {
    CAPTURE(block);
    const SparseSystem system = springs(mesh, random, block, 0.1);
    Prolongation prolongation(system.matrix, 0.04);
    REQUIRE(prolongation.coarse_rows() > 256);
    prolongation.build(system.matrix, 2);
    const Dense p = dense_of(prolongation, system.matrix);
    Eigen::VectorXd r(system.matrix.rows());
    for (double& v : r) v = random.uniform(-1, 1);
    std::vector<Real> restricted = in_rows(Eigen::VectorXd::Zero(p.cols()), block);
    prolongation.restrict(in_rows(r, block), restricted, 2);
    const Eigen::VectorXd expected = p.transpose() * r;
    CHECK((out_of_rows(restricted, block) - expected).norm() < 1e-5 * expected.norm());
    SparseMatrix coarse;
    for (int round = 0; round < 2; ++round) prolongation.galerkin(system.matrix, coarse, 1);
    Dense product = Dense::Zero(system.matrix.rows(), p.cols());  // A P
    const SparsityPattern& pattern = *system.matrix.pattern;
    const Index size = block * block;
    for (Index i = 0; i < pattern.rows(); ++i) {
      for (Index e = pattern.offsets[at(i)]; e < pattern.offsets[at(i) + 1]; ++e) {
        const Eigen::Map<const Dense, 0, Eigen::Stride<1, Eigen::Dynamic>> a(
            &system.matrix.values[at(e * size)], block, block,
            Eigen::Stride<1, Eigen::Dynamic>(1, block));
        product.middleRows(i * block, block) +=
            a * p.middleRows(pattern.columns[at(e)] * block, block);
      }
    }
    const Dense whole = p.transpose() * product;
    CHECK((dense_matrix(coarse) - whole).norm() < 1e-12 * whole.norm());
    SparseMatrix threaded;
    prolongation.galerkin(system.matrix, threaded, 2);
    CHECK(threaded.values == coarse.values);
  }
}

TEST_CASE("several right-hand sides are interpolated and restricted as each alone") {
  Random random(8);
  const SparseSystem system =
      springs(make_mesh(square_with_hole(30, Cells::triangles)), random, 1, 0.1);
  Prolongation prolongation(system.matrix, 0.04);
  prolongation.build(system.matrix, 1);
  const auto fine = at(system.matrix.rows()), coarse = at(prolongation.coarse_rows());
  std::vector<Real> r(4 * fine), x(4 * fine), copy(x), c(4 * coarse);
  for (Real& v : r) v = static_cast<Real>(random.uniform(-1, 1));
  for (Real& v : x) v = static_cast<Real>(random.uniform(-1, 1));
  const std::vector<Real> start = x;
  prolongation.restrict(r, c, 1, 4);
  prolongation.prolong(c, x, copy, 1, 4);
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<Real> one(fine), one_x(fine), one_copy(fine), one_c(coarse);
    for (std::size_t i = 0; i < fine; ++i) {
      one[i] = r[4 * i + k];
      one_x[i] = start[4 * i + k];
    }
    prolongation.restrict(one, one_c, 1);
    for (std::size_t a = 0; a < coarse; ++a) CHECK(c[4 * a + k] == one_c[a]);
    prolongation.prolong(one_c, one_x, one_copy, 1);
    for (std::size_t i = 0; i < fine; ++i) CHECK(x[4 * i + k] == one_x[i]);
  }
}
