#pragma once

#include <cmath>
#include <vector>

#include "core/parallel/parallel_for.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Maxima and sums of squares of scaled residuals, block of rows by block of rows: added up in the
/// order of the blocks they do not depend on the number of threads.
class BlockNorms {
 public:
  explicit BlockNorms(Index rows)
      : rows_(rows),
        max_(at((rows + parallel_block - 1) / parallel_block), 0.0),
        squares_(max_.size(), 0.0) {}

  void add(Index begin_of_block, double scaled) {
    const auto block = at(begin_of_block / parallel_block);
    max_[block] = larger(max_[block], scaled);
    squares_[block] += scaled * scaled;
  }
  ResidualNorms total() const {
    ResidualNorms norms;
    for (std::size_t b = 0; b < max_.size(); ++b) {
      norms.max = larger(norms.max, max_[b]);
      norms.rms += squares_[b];
    }
    norms.rms = rows_ > 0 ? std::sqrt(norms.rms / rows_) : 0;
    return norms;
  }

 private:
  /// Maximum that a NaN does not get lost in, whichever side it is on.
  static double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

  Index rows_;
  std::vector<double> max_, squares_;
};

}  // namespace winslow
