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
