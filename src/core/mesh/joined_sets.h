#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/index.h"

namespace winslow {

/// Sets of numbers that are joined pair by pair; a set is known by its lowest number.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(Index a, Index b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[at(high)] = low;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace winslow
