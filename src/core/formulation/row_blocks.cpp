#include "core/formulation/row_blocks.h"

#include <algorithm>

#include "core/linear/aggregation.h"

namespace winslow {

namespace {

using Triangles = std::vector<std::array<Index, 3>>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Triangle and place in it, row after row.
struct Stars {
  struct Corner {
    Index triangle, local;
  };
  std::vector<Index> offsets;
  std::vector<Corner> corners;

  Stars(const Triangles& triangles, std::span<const Index> row_of_node, Index rows)
      : offsets(at(rows) + 1, 0) {
    const auto each = [&](const auto& visit) {
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t l = 0; l < 3; ++l) {
          const Index row = row_of_node[at(triangles[t][l])];
          if (row >= 0) visit(at(row), Corner{static_cast<Index>(t), static_cast<Index>(l)});
        }
      }
    };
    each([&](std::size_t row, const Corner&) { ++offsets[row + 1]; });
    for (std::size_t i = 0; i < at(rows); ++i) offsets[i + 1] += offsets[i];
    corners.resize(at(offsets.back()));
    std::vector<Index> next(offsets.begin(), offsets.end() - 1);
    each([&](std::size_t row, const Corner& corner) { corners[at(next[row]++)] = corner; });
  }
  std::span<const Corner> of(Index row) const {
    return {corners.data() + offsets[at(row)], at(offsets[at(row) + 1] - offsets[at(row)])};
  }
};

std::shared_ptr<SparsityPattern> make_pattern(const Triangles& triangles, const Stars& stars,
                                              std::span<const Index> row_of_node, Index rows) {
  auto pattern = std::make_shared<SparsityPattern>();
  std::vector<Index> columns;
  for (Index i = 0; i < rows; ++i) {
    columns.assign(1, i);
    for (const Stars::Corner& corner : stars.of(i)) {
      for (const Index node : triangles[at(corner.triangle)]) {
        if (const Index row = row_of_node[at(node)]; row >= 0) columns.push_back(row);
      }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const auto place = std::lower_bound(columns.begin(), columns.end(), i) - columns.begin();
    pattern->diagonal.push_back(pattern->offsets.back() + static_cast<Index>(place));
    pattern->columns.insert(pattern->columns.end(), columns.begin(), columns.end());
    pattern->offsets.push_back(static_cast<Index>(pattern->columns.size()));
  }
  return pattern;
}

Index slot(const SparsityPattern& pattern, Index row, Index column) {
  if (column < 0) return -1;
  const auto begin = pattern.columns.begin() + pattern.offsets[at(row)];
  const auto end = pattern.columns.begin() + pattern.offsets[at(row) + 1];
  return static_cast<Index>(std::lower_bound(begin, end, column) - pattern.columns.begin());
}

}  // namespace

RowBlocks::RowBlocks(const Triangles& triangles, std::span<const Index> row_of_node, Index rows) {
  const Stars stars(triangles, row_of_node, rows);
  pattern_ = make_pattern(triangles, stars, row_of_node, rows);
  order_ = locality_ordering(*pattern_);
  std::vector<Index> place(triangles.size()), seen_by(triangles.size(), -1);
  for (Index begin = 0; begin < rows; begin += rows_per_block) {
    const Index block = begin / rows_per_block;
    for (Index p = begin; p < std::min(rows, begin + rows_per_block); ++p) {
      const Index row = order_[at(p)];
      for (const Stars::Corner& corner : stars.of(row)) {
        const std::size_t t = at(corner.triangle);
        if (seen_by[t] != block) {
          seen_by[t] = block;
          place[t] = static_cast<Index>(triangles_.size()) - triangle_offsets_.back();
          triangles_.push_back(corner.triangle);
        }
        const auto& nodes = triangles[t];
        const auto column = [&](Index step) {
          return row_of_node[at(nodes[at((corner.local + step) % 3)])];
        };
        incidences_.push_back({place[t], corner.local, slot(*pattern_, row, column(1)),
                               slot(*pattern_, row, column(2))});
      }
      incidence_offsets_.push_back(static_cast<Index>(incidences_.size()));
    }
    triangle_offsets_.push_back(static_cast<Index>(triangles_.size()));
  }
}

}  // namespace winslow
