#include "core/parallel/parallel_for.h"

#include <doctest/doctest.h>

#include <atomic>
#include <mutex>
#include <stdexcept>

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

TEST_CASE("no request means all cores, never none") {
  CHECK(thread_count(3) == 3);
  CHECK(thread_count(0) >= 1);
}
