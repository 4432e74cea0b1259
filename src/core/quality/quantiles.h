#pragma once

#include <cstddef>
#include <vector>

namespace winslow {

/// How a list of numbers is spread.
struct Quantiles {
  std::size_t count = 0;  ///< 0: there are none, and the rest says nothing
  double min = 0, low = 0, median = 0, high = 0, max = 0;  ///< low: 5 %, high: 95 %
};

/// Of the finite ones among the values. The q-quantile of n sorted values lies at place q (n - 1),
/// linearly between its two neighbours (R. J. Hyndman, Y. Fan, Am. Stat. 50, 1996, type 7).
Quantiles quantiles_of(std::vector<double> values);

}  // namespace winslow
