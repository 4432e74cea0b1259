#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "core/types.h"

namespace winslow::test {

/// Random numbers that are the same on every machine. A test that uses one captures the seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}

  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1.0p-53;
  }
  Vec2 vector(double low = -1, double high = 1) {
    const double x = uniform(low, high);
    return {x, uniform(low, high)};
  }
  /// In [0, count).
  Index index(Index count) {
    return static_cast<Index>(generator_() % static_cast<std::uint64_t>(count));
  }
  std::vector<Index> permutation(Index count) {
    std::vector<Index> p(static_cast<std::size_t>(count));
    std::iota(p.begin(), p.end(), 0);
    for (Index k = count - 1; k > 0; --k) {
      std::swap(p[static_cast<std::size_t>(k)], p[static_cast<std::size_t>(index(k + 1))]);
    }
    return p;
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace winslow::test
