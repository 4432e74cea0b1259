#include "core/formulation/row_blocks.h"

#include "core/linear/pattern_builder.h"
#include "core/linear/smoothed_aggregation.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// The number of the pair of two corners of a cell in SimplexPlaces::blocks.
template <int D>
std::size_t pair_number(std::size_t from, std::size_t to) {
  const std::size_t low = std::min(from, to), high = std::max(from, to);
  const std::size_t pair = low * (2 * D + 1 - low) / 2 + high - low - 1;
  return 2 * pair + (from < to ? 0 : 1);
}

/// The cells around a block of rows, with their places in the block's matrix.
template <int D>
struct BlockCells {
  std::vector<Index> cells;
  std::vector<distortion::SimplexPlaces<D>> places;
  Index entries = 0;
};

/// Lists the cells around one block of rows after the other. Its work memory is as large as the
/// mesh.
template <int D>
class BlockLister {
 public:
  using Cell = typename RowBlocks<D>::Cell;

  BlockLister(const std::vector<Cell>& cells, std::span<const Index> row_of_node,
              const CompressedRows& corners, const SparsityPattern& pattern)
      : cells_(cells),
        row_of_node_(row_of_node),
        corners_(corners),
        pattern_(pattern),
        number_(cells.size(), -1),
        entry_(at(corners.rows())) {}

  /// rows: of the block, in their order.
  BlockCells<D> list(std::span<const Index> rows) {
    BlockCells<D> out;
    for (const Index row : rows) {
      for (const Index corner : corners_[row]) {
        Index& number = number_[at(corner / (D + 1))];
        if (number >= 0) continue;
        number = static_cast<Index>(out.cells.size());
        out.cells.push_back(corner / (D + 1));
      }
    }
    distortion::SimplexPlaces<D> outside{};
    for (auto& row : outside.rows) row = RowBlocks<D>::rows_per_block;
    out.places.assign(out.cells.size(), outside);
    out.entries = 1;  // the unused one
    for (std::size_t p = 0; p < rows.size(); ++p) place_row(p, rows[p], out);
    for (const Index cell : out.cells) number_[at(cell)] = -1;
    return out;
  }

 private:
  /// Sets the places of a row, at position p of the block, in its cells.
  void place_row(std::size_t p, Index row, BlockCells<D>& out) {
    for (Index e = pattern_.offsets[at(row)]; e < pattern_.offsets[at(row) + 1]; ++e)
      entry_[at(pattern_.columns[at(e)])] = out.entries++;
    for (const Index corner : corners_[row]) {
      const std::size_t cell = at(corner / (D + 1)), own = at(corner % (D + 1));
      distortion::SimplexPlaces<D>& places = out.places[at(number_[cell])];
      places.rows[own] = static_cast<std::uint16_t>(p);
      for (std::size_t other = 0; other <= D; ++other) {
        const Index column = row_of_node_[at(cells_[cell][other])];
        if (other != own && column >= 0)
          places.blocks[pair_number<D>(own, other)] = entry_[at(column)];
      }
    }
  }

  const std::vector<Cell>& cells_;
  std::span<const Index> row_of_node_;
  const CompressedRows& corners_;
  const SparsityPattern& pattern_;
  std::vector<Index> number_;  // #cells: in the block, or -1
  std::vector<Index> entry_;   // #rows: that of the present row at each of its columns
};

}  // namespace

template <int D>
RowBlocks<D>::RowBlocks(const std::vector<Cell>& cells, std::span<const Index> row_of_node,
                        Index rows, int threads) {
  const CompressedRows corners = corners_of_rows(cells, row_of_node, rows);
  pattern_ = pattern_of_cells(cells, corners, row_of_node, threads);
  order_ = locality_ordering(*pattern_);
  const std::size_t blocks = block_count(rows, rows_per_block);
  std::vector<BlockCells<D>> parts(blocks);
  const auto fill = [&](Index begin, Index end) {
    BlockLister<D> lister(cells, row_of_node, corners, *pattern_);
    for (Index first = begin; first < end; first += rows_per_block) {
      const auto count = at(std::min(end - first, rows_per_block));
      parts[at(first / rows_per_block)] = lister.list({order_.data() + first, count});
    }
  };
  // Few listers, since each is as large as the mesh.
  constexpr Index most_listers = 16;
  const auto blocks_each = static_cast<Index>(blocks) / most_listers + 1;
  parallel_for(threads, rows, fill, blocks_each * rows_per_block);
  entries_.reserve(blocks);
  std::size_t count = 0;
  for (const BlockCells<D>& part : parts) count += part.cells.size();
  index_count(count, "cells of targets in blocks of rows");
  cells_.reserve(count);
  places_.reserve(count);
  for (BlockCells<D>& part : parts) {
    entries_.push_back(part.entries);
    cells_.insert(cells_.end(), part.cells.begin(), part.cells.end());
    places_.insert(places_.end(), part.places.begin(), part.places.end());
    cell_offsets_.push_back(static_cast<Index>(cells_.size()));
    part = {};  // frees memory
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
