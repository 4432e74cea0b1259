#pragma once

#include <numeric>

#include "core/counts.h"
#include "core/memory.h"

namespace winslow {

/// Compressed rows: row i holds values[offsets[i] .. offsets[i+1]).
struct CompressedRows {
  std::vector<Index> offsets{0};
  std::vector<Index> values;

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> operator[](Index row) const {
    const std::size_t begin = at(offsets[at(row)]);
    return {values.data() + begin, at(offsets[at(row) + 1]) - begin};
  }
  /// Ends a row, which holds the values that were added since the end of the last one.
  void end_row() { offsets.push_back(index_count(values.size(), "entries of a list")); }
};
inline std::size_t bytes_of(const CompressedRows& rows) {
  return bytes_of(rows.offsets, rows.values);
}

/// Rows of pairs (row, value): row i holds the values of its pairs, in their order. each(add) calls
/// add(row, value) for every pair; it is called twice, the first time to count them. Throws
/// UsageError for more pairs than an Index can number.
template <typename Each>
CompressedRows rows_of(Index row_count, const Each& each) {
  CompressedRows rows;
  rows.offsets.assign(at(row_count) + 1, 0);
  each([&](Index row, Index) { ++rows.offsets[at(row) + 1]; });
  add_up(rows.offsets, "entries of a list");
  rows.values.resize(at(rows.offsets.back()));
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  each([&](Index row, Index value) { rows.values[at(next[at(row)]++)] = value; });
  return rows;
}

/// Index of the first item that equals a value; the size of the list if there is none.
template <class List, class Value>
constexpr std::size_t index_of(const List& list, const Value& value) {
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), value) - list.begin());
}

/// Sorts a list and removes repeated values.
template <typename T>
void sort_unique(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Disjoint sets of the numbers 0 to count - 1, at first of one number each (union-find). The
/// lowest number of a set stands for it.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count = 0) { reset(count); }
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The lowest number of the set that i is in.
  Index find(Index i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  /// Makes the sets of a and b one. False if they were one before.
  bool join(Index a, Index b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[at(high)] = low;
    return low != high;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace winslow
