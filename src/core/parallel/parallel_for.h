#pragma once

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "core/types.h"

namespace winslow {

/// Number of threads to use for a request: 0 means all cores.
inline int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls body(begin, end) on blocks that cover [0, n), on several threads if n is worth it. Blocks
/// have a fixed size and never depend on the number of threads, so a body that writes per block
/// (and sums the blocks in order afterwards) gives the same bits at any thread count.
inline constexpr Index parallel_block = 4096;

/// block: size of the blocks, smaller for a body that takes long over each of them.
template <typename Body>
void parallel_for(int threads, Index n, Body&& body, Index block = parallel_block) {
  const Index blocks = (n + block - 1) / block;
  const auto run = [&](Index first_block, Index stride) {
    for (Index b = first_block; b < blocks; b += stride) {
      body(b * block, std::min(n, (b + 1) * block));
    }
  };
  const Index workers = std::min<Index>(thread_count(threads), blocks);
  if (workers <= 1) {
    run(0, 1);
    return;
  }
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(workers));
  const auto work = [&](Index w) {
    try {
      run(w, workers);
    } catch (...) {
      errors[static_cast<std::size_t>(w)] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> pool;
    pool.reserve(static_cast<std::size_t>(workers));
    for (Index w = 0; w < workers; ++w) {
      try {
        pool.emplace_back(work, w);
      } catch (const std::system_error&) {
        work(w);  // no memory for another thread: the same work here
      }
    }
  }
  for (const auto& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace winslow
