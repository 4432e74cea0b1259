#include "core/formulation/row_blocks.h"

#include "core/linear/pattern_builder.h"
#include "core/linear/smoothed_aggregation.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Positions of all rows in the order, and in the matrices of their blocks.
template <int D>
class RowPlaces {
 public:
  RowPlaces(const SparsityPattern& pattern, const std::vector<Index>& order)
      : pattern_(pattern), position_(order.size()), start_{0} {
    start_.reserve(order.size() + 1);
    for (std::size_t p = 0; p < order.size(); ++p) {
      const std::size_t row = at(order[p]);
      position_[row] = static_cast<Index>(p);
      start_.push_back(start_.back() + pattern.offsets[row + 1] - pattern.offsets[row]);
    }
  }

  /// Number of entries of the matrix of the rows at the positions [begin, end): one unused entry,
  /// and those of the rows.
  Index entries(Index begin, Index end) const { return 1 + start_[at(end)] - start_[at(begin)]; }

  /// Whether the row at position p is the first of the block that has the cell. rows: of the cell's
  /// nodes.
  bool meets_first(const std::array<Index, D + 1>& rows, Index p, Index begin) const {
    return std::none_of(rows.begin(), rows.end(), [&](Index row) {
      return row >= 0 && position_[at(row)] >= begin && position_[at(row)] < p;
    });
  }

  /// The places of a cell in the matrix of the block with the positions [begin, end).
  distortion::SimplexPlaces<D> in_block(const std::array<Index, D + 1>& rows, Index begin,
                                        Index end) const {
    const auto is_in_block = [&](Index row) {
      return row >= 0 && position_[at(row)] >= begin && position_[at(row)] < end;
    };
    const auto entry = [&](Index row, Index column) {
      if (!is_in_block(row) || column < 0) return 0;
      return entries(begin, position_[at(row)]) + pattern_.find(row, column) -
             pattern_.offsets[at(row)];
    };
    distortion::SimplexPlaces<D> places{};
    for (std::size_t corner = 0; corner <= D; ++corner) {
      const Index row = rows[corner];
      places.rows[corner] = static_cast<std::uint16_t>(
          is_in_block(row) ? position_[at(row)] - begin : RowBlocks<D>::rows_per_block);
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
  const SparsityPattern& pattern_;
  std::vector<Index> position_;  // of each row in the order
  std::vector<Index> start_;     // entries before each position
};

}  // namespace

template <int D>
RowBlocks<D>::RowBlocks(const std::vector<Cell>& cells, std::span<const Index> row_of_node,
                        Index rows, int threads) {
  const CompressedRows corners = corners_of_rows(cells, row_of_node, rows);
  pattern_ = pattern_of_cells(cells, corners, row_of_node, threads);
  order_ = locality_ordering(*pattern_);
  const RowPlaces<D> places(*pattern_, order_);
  struct Part {
    std::vector<Index> cells;
    std::vector<distortion::SimplexPlaces<D>> places;
  };
  const std::size_t blocks = block_count(rows, rows_per_block);
  std::vector<Part> parts(blocks);
  entries_.resize(blocks);
  const auto fill = [&](Index begin, Index end) {
    const auto block = at(begin / rows_per_block);
    entries_[block] = places.entries(begin, end);
    for (Index p = begin; p < end; ++p) {
      for (const Index corner : corners[order_[at(p)]]) {
        const Index t = corner / (D + 1);
        Cell rows_of_cell;
        std::transform(cells[at(t)].begin(), cells[at(t)].end(), rows_of_cell.begin(),
                       [&](Index node) { return row_of_node[at(node)]; });
        if (!places.meets_first(rows_of_cell, p, begin)) continue;
        parts[block].cells.push_back(t);
        parts[block].places.push_back(places.in_block(rows_of_cell, begin, end));
      }
    }
  };
  parallel_for(threads, rows, fill, rows_per_block);
  for (const Part& part : parts) {
    cells_.insert(cells_.end(), part.cells.begin(), part.cells.end());
    places_.insert(places_.end(), part.places.begin(), part.places.end());
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
