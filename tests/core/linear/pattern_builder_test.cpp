#include "core/linear/pattern_builder.h"

#include <doctest/doctest.h>

using namespace winslow;

TEST_CASE("a pattern is the same however its rows are dealt out") {
  constexpr Index rows = 1000;
  // Row i: itself, its double and its half, if there are such rows; not in order.
  const auto begin_block = [] {
    return [](Index i, std::vector<Index>& columns) {
      columns.push_back(i);
      if (i > 0 && 2 * i < rows) columns.push_back(2 * i);
      if (i > 0 && i % 2 == 0) columns.push_back(i / 2);
    };
  };
  const auto expected = build_pattern(rows, rows, 1, begin_block);
  REQUIRE(expected->rows() == rows);
  for (Index i = 0; i < rows; ++i) {
    const auto begin = at(expected->offsets[at(i)]), end = at(expected->offsets[at(i) + 1]);
    std::vector<Index> row{i};
    if (i > 0 && 2 * i < rows) row.push_back(2 * i);
    if (i > 0 && i % 2 == 0) row.insert(row.begin(), i / 2);
    CHECK(std::vector(expected->columns.begin() + static_cast<std::ptrdiff_t>(begin),
                      expected->columns.begin() + static_cast<std::ptrdiff_t>(end)) == row);
    CHECK(expected->columns[at(expected->diagonal[at(i)])] == i);
  }
  for (const Index block : {1, 7, 256, 5000}) {
    const auto pattern = build_pattern(rows, block, 3, begin_block);
    CHECK(pattern->offsets == expected->offsets);
    CHECK(pattern->columns == expected->columns);
    CHECK(pattern->diagonal == expected->diagonal);
  }
}
