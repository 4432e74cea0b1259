#include "core/formulation/row_blocks.h"

#include <algorithm>
#include <utility>

#include "core/linear/aggregation.h"

namespace winslow {

namespace {

/// The cells at each row.
struct Stars {
  std::vector<Index> offsets;
  std::vector<Index> entries;

  template <std::size_t N>
  Stars(const std::vector<std::array<Index, N>>& cells, std::span<const Index> row_of_node,
        Index rows)
      : offsets(at(rows) + 1, 0) {
    const auto each = [&](const auto& visit) {
      for (std::size_t t = 0; t < cells.size(); ++t) {
        for (const Index node : cells[t]) {
          if (const Index row = row_of_node[at(node)]; row >= 0) visit(at(row), t);
        }
      }
    };
    each([&](std::size_t row, std::size_t) { ++offsets[row + 1]; });
    for (std::size_t i = 0; i < at(rows); ++i) offsets[i + 1] += offsets[i];
    entries.resize(at(offsets.back()));
    std::vector<Index> next(offsets.begin(), offsets.end() - 1);
    each([&](std::size_t row, std::size_t t) { entries[at(next[row]++)] = static_cast<Index>(t); });
  }
  std::span<const Index> of(Index row) const {
    return {entries.data() + offsets[at(row)], at(offsets[at(row) + 1] - offsets[at(row)])};
  }
};

template <std::size_t N>
std::shared_ptr<SparsityPattern> make_pattern(const std::vector<std::array<Index, N>>& cells,
                                              const Stars& stars,
                                              std::span<const Index> row_of_node, Index rows) {
  auto pattern = std::make_shared<SparsityPattern>();
  std::vector<Index> columns;
  for (Index i = 0; i < rows; ++i) {
    columns.assign(1, i);
    for (const Index t : stars.of(i)) {
      for (const Index node : cells[at(t)]) {
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

/// Places in the matrix of one block of rows.
template <int D>
class BlockPlaces {
 public:
  BlockPlaces(const SparsityPattern& pattern, const std::vector<Index>& order, Index rows)
      : pattern_(pattern), order_(order), position_(at(rows), -1), start_(at(rows), 0) {}

  /// The rows at the positions [begin, end). Returns the number of entries.
  Index set_block(Index begin, Index end) {
    begin_ = begin;
    end_ = end;
    Index entries = 1;
    for (Index p = begin; p < end; ++p) {
      const std::size_t row = at(order_[at(p)]);
      position_[row] = p;
      start_[row] = entries;
      entries += pattern_.offsets[row + 1] - pattern_.offsets[row];
    }
    return entries;
  }
  distortion::SimplexPlaces<D> of(const std::array<Index, D + 1>& rows) const {
    distortion::SimplexPlaces<D> places{};
    for (std::size_t corner = 0; corner <= D; ++corner) {
      const Index row = rows[corner];
      places.rows[corner] = static_cast<std::uint16_t>(
          is_in_block(row) ? position_[at(row)] - begin_ : RowBlocks<D>::rows_per_block);
    }
    std::size_t k = 0;
    for (std::size_t first = 0; first <= D; ++first) {
      for (std::size_t second = first + 1; second <= D; ++second) {
        places.blocks[k++] = entry(rows[first], rows[second]);
        places.blocks[k++] = entry(rows[second], rows[first]);
      }
    }
    return places;
  }

 private:
  bool is_in_block(Index row) const {
    return row >= 0 && position_[at(row)] >= begin_ && position_[at(row)] < end_;
  }
  Index entry(Index row, Index column) const {
    if (!is_in_block(row) || column < 0) return 0;
    const auto begin = pattern_.columns.begin() + pattern_.offsets[at(row)];
    const auto end = pattern_.columns.begin() + pattern_.offsets[at(row) + 1];
    return start_[at(row)] + static_cast<Index>(std::lower_bound(begin, end, column) - begin);
  }

  const SparsityPattern& pattern_;
  const std::vector<Index>& order_;
  std::vector<Index> position_, start_;
  Index begin_ = 0, end_ = 0;
};

}  // namespace

template <int D>
RowBlocks<D>::RowBlocks(const std::vector<Cell>& cells, std::span<const Index> row_of_node,
                        Index rows) {
  const Stars stars(cells, row_of_node, rows);
  pattern_ = make_pattern(cells, stars, row_of_node, rows);
  order_ = locality_ordering(*pattern_);
  BlockPlaces<D> places(*pattern_, order_, rows);
  std::vector<Index> seen_by(cells.size(), -1);
  for (Index begin = 0; begin < rows; begin += rows_per_block) {
    const Index end = std::min(rows, begin + rows_per_block);
    const Index block = begin / rows_per_block;
    entries_.push_back(places.set_block(begin, end));
    for (Index p = begin; p < end; ++p) {
      for (const Index t : stars.of(order_[at(p)])) {
        if (std::exchange(seen_by[at(t)], block) == block) continue;
        Cell rows_of_cell;
        std::transform(cells[at(t)].begin(), cells[at(t)].end(), rows_of_cell.begin(),
                       [&](Index node) { return row_of_node[at(node)]; });
        cells_.push_back(t);
        places_.push_back(places.of(rows_of_cell));
      }
    }
    cell_offsets_.push_back(static_cast<Index>(cells_.size()));
  }
}

template <int D>
std::vector<Index> RowBlocks<D>::renumber_cells() {
  const Index most = cells_.empty() ? -1 : *std::max_element(cells_.begin(), cells_.end());
  std::vector<Index> number(at(most + 1), -1), old_number;
  for (std::size_t block = 0; block + 1 < cell_offsets_.size(); ++block) {
    first_new_.push_back(static_cast<Index>(old_number.size()));
    for (Index i = cell_offsets_[block]; i < cell_offsets_[block + 1]; ++i) {
      Index& t = cells_[at(i)];
      if (number[at(t)] < 0) {
        number[at(t)] = static_cast<Index>(old_number.size());
        old_number.push_back(t);
      }
      t = number[at(t)];
    }
  }
  return old_number;
}

template class RowBlocks<2>;
template class RowBlocks<3>;

}  // namespace winslow
