#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/index.h"

namespace winslow {

/// Compressed rows: row i holds values[offsets[i] .. offsets[i+1]).
struct CompressedRows {
  std::vector<Index> offsets{0};
  std::vector<Index> values;

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> operator[](Index row) const {
    const auto b = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row)]);
    const auto n = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row) + 1]) - b;
    return {values.data() + b, n};
  }
  /// Ends a row: values that were added since the last one make it up.
  void end_row() { offsets.push_back(static_cast<Index>(values.size())); }
};

}  // namespace winslow
