#include "core/parallel/parallel_for.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

using namespace winslow;

TEST_CASE("blocks cover the range once and do not depend on the number of threads") {
  for (const Index n : {0, 1, parallel_block - 1, parallel_block, parallel_block + 1, 50000}) {
    std::vector<std::pair<Index, Index>> expected;
    parallel_for(1, n, [&](Index begin, Index end) { expected.emplace_back(begin, end); });
    Index covered = 0;
    for (const auto& [begin, end] : expected) {
      CHECK(begin == covered);
      covered = end;
    }
    CHECK(covered == n);
    for (const int threads : {0, 2, 3, 64}) {
      std::mutex mutex;
      std::vector<std::pair<Index, Index>> blocks;
      parallel_for(threads, n, [&](Index begin, Index end) {
        const std::lock_guard lock(mutex);
        blocks.emplace_back(begin, end);
      });
      std::sort(blocks.begin(), blocks.end());
      CHECK(blocks == expected);
    }
  }
}

TEST_CASE("an exception on any thread comes out, after all have ended") {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> running = 0;
    const auto body = [&](Index begin, Index) {
      ++running;
      if (begin == 2 * parallel_block) {
        --running;
        throw std::runtime_error("block 2");
      }
      --running;
    };
    CHECK_THROWS_WITH_AS(parallel_for(threads, 5 * parallel_block, body), "block 2",
                         std::runtime_error);
    CHECK(running == 0);
  }
}

TEST_CASE("of several exceptions that of the first block comes out") {
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto body = [](Index begin, Index) {
      if (begin >= 3) throw std::runtime_error("block " + std::to_string(begin));
    };
    CHECK_THROWS_WITH_AS(parallel_for(4, 50, body, 1), "block 3", std::runtime_error);
  }
}

TEST_CASE("loops within loops, and loops of several threads at once, do all of their work") {
  constexpr Index outer = 40, inner = 50, callers = 4;
  std::atomic<Index> sum = 0;
  const auto call = [&] {
    parallel_for(
        3, outer,
        [&](Index i, Index) {
          parallel_for(
              2, inner, [&](Index k, Index) { sum += i * inner + k; }, 1);
        },
        1);
  };
  {
    std::vector<std::jthread> threads;
    for (Index k = 0; k < callers; ++k) threads.emplace_back(call);
  }
  constexpr Index n = outer * inner;
  CHECK(sum == callers * (n * (n - 1) / 2));
}

TEST_CASE("no request means all cores, never none") {
  CHECK(thread_count(3) == 3);
  CHECK(thread_count(0) >= 1);
}

TEST_CASE("the processes that MPI has started are counted") {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    ::setenv(name, "8", 1);
    CHECK(mpi_processes() == 8);
    ::unsetenv(name);
  }
  CHECK(mpi_processes() == 1);
}
