#pragma once

#include "core/counts.h"
#include "core/linear/sparse_system.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

/// Builds a pattern of `rows` rows, `block` rows at a time on several threads. begin_block() is
/// called for each block of rows and returns a function list(row, columns). This function is called
/// for the rows of the block in ascending order. It fills the empty `columns` with the columns of
/// the row, in any order, once each, including the row itself. Throws UsageError for more entries
/// than an Index can number.
template <typename BeginBlock>
std::shared_ptr<SparsityPattern> build_pattern(Index rows, Index block, int threads,
                                               const BeginBlock& begin_block) {
  std::vector<SparsityPattern> parts(block_count(rows, block));
  parallel_for(
      threads, rows,
      [&](Index begin, Index end) {
        SparsityPattern& part = parts[at(begin / block)];
        auto list = begin_block();
        std::vector<Index> columns;
        for (Index row = begin; row < end; ++row) {
          columns.clear();
          list(row, columns);
          std::sort(columns.begin(), columns.end());
          const auto own = std::lower_bound(columns.begin(), columns.end(), row);
          part.diagonal.push_back(part.offsets.back() + static_cast<Index>(own - columns.begin()));
          part.columns.insert(part.columns.end(), columns.begin(), columns.end());
          part.offsets.push_back(index_count(part.columns.size(), entries_of_matrix));
        }
      },
      block);
  auto pattern = std::make_shared<SparsityPattern>();
  std::size_t entries = 0;
  for (const SparsityPattern& part : parts) entries += part.columns.size();
  pattern->columns.reserve(at(index_count(entries, entries_of_matrix)));
  pattern->offsets.reserve(at(rows) + 1);
  pattern->diagonal.reserve(at(rows));
  for (SparsityPattern& part : parts) {
    const Index before = pattern->offsets.back();
    pattern->columns.insert(pattern->columns.end(), part.columns.begin(), part.columns.end());
    for (std::size_t i = 0; i < part.diagonal.size(); ++i) {
      pattern->diagonal.push_back(before + part.diagonal[i]);
      pattern->offsets.push_back(before + part.offsets[i + 1]);
    }
    part = {};  // frees memory
  }
  return pattern;
}

/// Builds a pattern from the columns of each row, in any order, duplicates allowed, including the
/// row itself.
inline std::shared_ptr<SparsityPattern> pattern_of(std::vector<std::vector<Index>> columns) {
  const auto list = [&](Index row, std::vector<Index>& out) {
    out.swap(columns[at(row)]);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  };
  const auto rows = static_cast<Index>(columns.size());
  return build_pattern(rows, std::max<Index>(rows, 1), 1, [&] { return list; });
}

}  // namespace winslow
