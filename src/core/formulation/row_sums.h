#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formulation/simplex_kernel.h"
#include "core/formulation/sliding_rows.h"
#include "core/problem/smoothing_problem.h"

/// What the variational form sums up, row by row.
namespace winslow {

inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// Sums of what blocks of rows came to, in the order of the blocks.
struct NormSum {
  double max = 0, squares = 0;
  Index count = 0;

  void add(double scaled) {
    max = larger(max, scaled);
    squares += scaled * scaled;
    ++count;
  }
  static ResidualNorms total(const std::vector<NormSum>& parts) {
    NormSum sum;
    for (const NormSum& part : parts) {
      sum.max = larger(sum.max, part.max);
      sum.squares += part.squares;
      sum.count += part.count;
    }
    return {sum.max, sum.count > 0 ? std::sqrt(sum.squares / sum.count) : 0};
  }
};

/// What the cells around one row came to: diagonal block, gradient, length of their edges at the
/// node.
template <int D>
struct RowSum {
  const double* v;
  const double* gradient() const { return v + distortion::SimplexLayout<D>::gradient; }
  /// Distance by which the node alone would move, over the mean edge. cells: around the node. foot:
  /// of a node that slides; null for others.
  double scaled(Index cells, const Foot* foot) const {
    double square = 0;
    for (std::ptrdiff_t k = 0; k < D; ++k) square += gradient()[k] * gradient()[k];
    const double g = foot ? SlidingRows<D>::along(*foot, gradient()) : std::sqrt(square);
    return scale_of(cells).scaled(g);
  }
  /// What a gradient compares with.
  struct Scale {
    double trace = 0, edges = 0;
    Index cells = 0;
    double scaled(double gradient) const {
      const double mean_edge = edges / (D * std::max<Index>(cells, 1));
      const double scale = trace / D * mean_edge;
      return scale > 0 ? gradient / scale : gradient;
    }
  };
  Scale scale_of(Index cells) const {
    Scale scale{0, gradient()[D], cells};
    for (std::ptrdiff_t k = 0; k < D; ++k) scale.trace += v[(D + 1) * k];
    return scale;
  }
};

}  // namespace winslow
