#pragma once

#include <cstddef>

namespace winslow {

/// Threads for a loop over about so many numbers, out of those that may be used: waking threads
/// takes as long as thirty thousand multiplications. No result depends on it (see parallel_for).
inline int worthwhile(int threads, std::size_t numbers) {
  constexpr std::size_t least = 30'000;
  return numbers < least ? 1 : threads;
}

}  // namespace winslow
