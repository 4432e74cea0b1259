#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "core/types.h"

namespace winslow {

/// Calls work(0), ..., work(count - 1) once each, on this thread and on pooled threads, and returns
/// when all have returned. Any number of threads may call it at once, also from within work. work
/// must not throw. If no other thread is available, the calling thread makes all calls.
void run_on_threads(Index count, void (*work)(void* data, Index share), void* data);

/// The same for any callable.
template <typename Work>
void run_on_threads(Index count, const Work& work) {
  run_on_threads(
      count, [](void* data, Index share) { (*static_cast<const Work*>(data))(share); },
      const_cast<Work*>(&work));
}

/// Number of threads to use for a request. 0 means all cores, and one thread in a process that MPI
/// has started: its other processes have the other cores.
int thread_count(int requested);
/// Number of processes that mpirun, or what else starts MPI, has started together with this one,
/// from the environment; 1: none.
int mpi_processes();

/// Calls body(begin, end) on blocks that cover [0, n), on several threads if n is large enough.
/// Blocks have a fixed size and never depend on the number of threads, so a body that writes per
/// block (and sums the blocks in order afterwards) gives the same bits at any thread count.
inline constexpr Index parallel_block = 4096;
/// How many blocks cover [0, n).
inline std::size_t block_count(Index n, Index block = parallel_block) {
  return (at(n) + at(block) - 1) / at(block);
}

/// Size of a few large blocks that cover [0, n), for loops whose blocks each need memory as large
/// as the mesh.
inline Index few_blocks(Index n) {
  constexpr Index most = 16;
  return std::max(parallel_block, n / most + 1);
}

/// block: size of the blocks, smaller for an expensive body. If bodies throw, parallel_for()
/// rethrows the exception of the lowest block after all threads have ended.
template <typename Body>
void parallel_for(int threads, Index n, Body&& body, Index block = parallel_block) {
  // 64-bit: ends of blocks near the largest Index lie beyond it.
  const auto blocks = static_cast<std::int64_t>(block_count(n, block));
  const auto carry_out = [&](std::int64_t b) {
    body(static_cast<Index>(b * block),
         static_cast<Index>(std::min<std::int64_t>(n, (b + 1) * block)));
  };
  const auto workers = static_cast<Index>(std::min<std::int64_t>(thread_count(threads), blocks));
  if (workers <= 1) {
    for (std::int64_t b = 0; b < blocks; ++b) carry_out(b);
    return;
  }
  struct Failure {
    std::int64_t block;
    std::exception_ptr error;
  };
  std::vector<Failure> failures(static_cast<std::size_t>(workers));
  std::atomic<std::int64_t> next = 0;
  const auto work = [&](Index worker) {
    std::int64_t b = 0;
    try {
      while ((b = next.fetch_add(1, std::memory_order_relaxed)) < blocks) carry_out(b);
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
