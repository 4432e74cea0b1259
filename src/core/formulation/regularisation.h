#pragma once

#include <cmath>

#include "core/problem/smoothing_problem.h"

/// How large the regularised determinants of cells are chosen, from the determinants as they are.
namespace winslow {

/// Mean |determinant| of the cells around each cell's nodes.
template <std::size_t N>
std::vector<double> sizes_around(const std::vector<std::array<Index, N>>& cells,
                                 std::span<const double> determinants, Index node_count) {
  std::vector<double> sum(at(node_count), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (std::size_t t = 0; t < cells.size(); ++t) {
    for (const Index node : cells[t]) {
      sum[at(node)] += std::abs(determinants[t]);
      ++count[at(node)];
    }
  }
  std::vector<double> sizes;
  sizes.reserve(cells.size());
  for (const auto& nodes : cells) {
    double size = 0;
    for (const Index node : nodes) size += sum[at(node)] / count[at(node)];
    sizes.push_back(std::max(size / static_cast<double>(N), std::numeric_limits<double>::min()));
  }
  return sizes;
}

/// See UntanglingProblem::regularisation().
inline Regularisation regularise(std::span<const double> determinants,
                                 std::span<const double> sizes, double softness) {
  Regularisation out;
  out.size.reserve(determinants.size());
  for (std::size_t t = 0; t < determinants.size(); ++t)
    out.size.push_back(std::hypot(softness * sizes[t], std::min(0.0, determinants[t])));
  return out;
}

/// See UntanglingProblem::full_regularisation().
inline Regularisation regularise_fully(std::span<const double> determinants) {
  constexpr double far_beyond = 1e6;  // the largest determinant
  double largest = std::numeric_limits<double>::min();
  for (const double determinant : determinants) largest = std::max(largest, std::abs(determinant));
  return {std::vector<double>(determinants.size(), far_beyond * largest), {}};
}

}  // namespace winslow
