#include "core/formulation/node_pattern.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("the pattern of the free nodes holds each free node and its free neighbours") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const auto topology = Topology::build(square_with_two_holes(10, cells));
    const NodePattern free(*topology, topology->interior_nodes());
    const SparsityPattern& p = *free.pattern;
    REQUIRE(p.rows() == static_cast<Index>(topology->interior_nodes().size()));
    for (Index node = 0; node < topology->node_count(); ++node) {
      const Index row = free.row_of_node[at(node)];
      CHECK((row >= 0) == !topology->on_boundary(node));
      if (row < 0) continue;
      CHECK(topology->interior_nodes()[at(row)] == node);
      const auto begin = p.columns.begin() + p.offsets[at(row)];
      const auto end = p.columns.begin() + p.offsets[at(row) + 1];
      CHECK(std::adjacent_find(begin, end, std::greater_equal<>()) == end);
      CHECK(p.columns[at(p.diagonal[at(row)])] == row);
      std::ptrdiff_t expected = 1;
      const auto neighbours = topology->neighbours(node);
      const auto first = at(topology->neighbour_rows().offsets[at(node)]);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Index entry = free.entry_of_neighbour[first + k];
        CHECK((entry >= 0) == !topology->on_boundary(neighbours[k]));
        if (entry < 0) continue;
        ++expected;
        CHECK(entry >= p.offsets[at(row)]);
        CHECK(entry < p.offsets[at(row) + 1]);
        CHECK(p.columns[at(entry)] == free.row_of_node[at(neighbours[k])]);
      }
      CHECK(end - begin == expected);
    }
  }
}
