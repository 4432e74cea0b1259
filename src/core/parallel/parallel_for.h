#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "core/parallel/thread_pool.h"
#include "core/types.h"

namespace winslow {

/// Number of threads to use for a request: 0 means all cores.
inline int thread_count(int requested) {
  static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return requested > 0 ? requested : cores;
}

/// Calls body(begin, end) on blocks that cover [0, n), on several threads if n is worth it. Blocks
/// have a fixed size and never depend on the number of threads, so a body that writes per block
/// (and sums the blocks in order afterwards) gives the same bits at any thread count.
inline constexpr Index parallel_block = 4096;

/// block: size of the blocks, smaller for a body that takes long over each of them. Of what bodies
/// throw, the exception of the first block comes out, when all have ended.
template <typename Body>
void parallel_for(int threads, Index n, Body&& body, Index block = parallel_block) {
  const Index blocks = (n + block - 1) / block;
  const Index workers = std::min<Index>(thread_count(threads), blocks);
  if (workers <= 1) {
    for (Index b = 0; b < blocks; ++b) body(b * block, std::min(n, (b + 1) * block));
    return;
  }
  struct Failure {
    Index block;
    std::exception_ptr error;
  };
  std::vector<Failure> failures(static_cast<std::size_t>(workers));
  std::atomic<Index> next = 0;
  const auto work = [&](Index worker) {
    Index b = 0;
    try {
      while ((b = next.fetch_add(1, std::memory_order_relaxed)) < blocks) {
        body(b * block, std::min(n, (b + 1) * block));
      }
    } catch (...) {
      failures[static_cast<std::size_t>(worker)] = {b, std::current_exception()};
    }
  };
  run_on_threads(workers, work);
  const Failure* first = nullptr;
  for (const Failure& failure : failures) {
    if (failure.error && (!first || failure.block < first->block)) first = &failure;
  }
  if (first) std::rethrow_exception(first->error);
}

}  // namespace winslow
