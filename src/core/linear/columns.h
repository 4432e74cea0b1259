#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace winslow {

/// Calls solve_one(b, x) for each of several right-hand sides that lie row after row, on contiguous
/// copies; x goes in as the first guess and comes out as the solution.
template <typename SolveOne>
void for_each_column(std::span<const double> rhs, int columns, std::span<double> x,
                     SolveOne&& solve_one) {
  if (columns == 1) {
    solve_one(rhs, x);
    return;
  }
  const auto stride = static_cast<std::size_t>(columns);
  std::vector<double> b(rhs.size() / stride), y(b.size());
  for (std::size_t c = 0; c < stride; ++c) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      b[i] = rhs[i * stride + c];
      y[i] = x[i * stride + c];
    }
    solve_one(std::span<const double>(b), std::span<double>(y));
    for (std::size_t i = 0; i < b.size(); ++i) x[i * stride + c] = y[i];
  }
}

}  // namespace winslow
