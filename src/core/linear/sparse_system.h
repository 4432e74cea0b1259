#pragma once

#include <memory>

#include "core/memory.h"

namespace winslow {

/// What index_count() calls the entries of a pattern.
inline constexpr const char* entries_of_matrix = "entries of a matrix";

/// Pattern of a sparse matrix in compressed rows, columns ascending, diagonal always present.
struct SparsityPattern {
  std::vector<Index> offsets{0};
  std::vector<Index> columns;
  std::vector<Index> diagonal;  ///< position of the diagonal entry of each row

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  /// Position of the entry of a row in a column; the entry must exist.
  Index find(Index row, Index column) const {
    const auto first = columns.begin() + offsets[at(row)];
    const auto last = columns.begin() + offsets[at(row) + 1];
    return static_cast<Index>(std::lower_bound(first, last, column) - columns.begin());
  }
};

inline std::size_t bytes_of(const SparsityPattern& pattern) {
  return bytes_of(pattern.offsets, pattern.columns, pattern.diagonal);
}
inline std::size_t bytes_of(const std::shared_ptr<const SparsityPattern>& pattern) {
  return pattern ? bytes_of(*pattern) : 0;
}

/// A square matrix of dense blocks. The pattern is that of the blocks: each pattern row has `block`
/// unknowns (e.g. the displacement components of a node).
struct SparseMatrix {
  std::shared_ptr<const SparsityPattern> pattern;  ///< block rows
  int block = 1;                                   ///< size of a block: block by block
  /// The matrix equals its transpose exactly; both triangles are stored.
  bool symmetric = false;
  /// True for a mesh in space: its factors have much more fill-in than those of a plane mesh of the
  /// same size.
  bool in_space = false;
  /// #entries by block by block, row-major within a block: entry e, row r, column c of it lies at
  /// values[(e * block + r) * block + c].
  std::vector<double> values;

  /// Scalar rows.
  Index rows() const { return pattern ? pattern->rows() * block : 0; }
};

/// A X = B with several right-hand sides.
struct SparseSystem {
  SparseMatrix matrix;
  int columns = 1;          ///< right-hand sides
  std::vector<double> rhs;  ///< #scalar rows by columns, row after row
};

}  // namespace winslow
