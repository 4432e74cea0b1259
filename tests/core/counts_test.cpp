#include "core/counts.h"

#include <doctest/doctest.h>

#include <atomic>
#include <mutex>

#include "core/linear/factorisation.h"
#include "core/parallel/parallel_for.h"

using namespace winslow;

namespace {

constexpr Index most = std::numeric_limits<Index>::max();
constexpr auto too_many = at(most) + 1;

}  // namespace

TEST_CASE("counts up to the largest Index are taken, greater ones refused with their number") {
  CHECK(index_count(0, "nodes") == 0);
  CHECK(index_count(at(most), "nodes") == most);
  CHECK_THROWS_WITH_AS(
      index_count(too_many, "corners of elements"),
      "2147483648 corners of elements, expected at most 2147483647: the mesh is too large, "
      "divide it",
      UsageError);
  // What wraps around to a small positive number.
  CHECK_THROWS_AS(index_count((std::size_t{1} << 32U) + 5, "nodes"), UsageError);
}

TEST_CASE("sums of counts beyond the largest Index are refused instead of wrapping") {
  std::vector<Index> counts{3, 0, 2};
  add_up(counts, "entries");
  CHECK(counts == std::vector<Index>{3, 3, 5});
  std::vector<Index> full{0, most - 1, 1, 0};
  add_up(full, "entries");
  CHECK(full == std::vector<Index>{0, most - 1, most, most});
  std::vector<Index> beyond{0, most, 1};
  CHECK_THROWS_AS(add_up(beyond, "entries"), UsageError);
  std::vector<Index> twice{most, most, most};  // the sum of three wraps to a positive number
  CHECK_THROWS_AS(add_up(twice, "entries"), UsageError);
}

TEST_CASE("loops over as many items as an Index numbers cover each once") {
  CHECK(block_count(most, parallel_block) == 524288);
  CHECK(block_count(most, most) == 1);
  for (const int threads : {1, 4}) {
    for (const Index block : {Index{1} << 24, Index{3} << 28, most}) {
      CAPTURE(threads);
      CAPTURE(block);
      std::mutex mutex;
      std::vector<std::pair<Index, Index>> ranges;
      parallel_for(
          threads, most,
          [&](Index begin, Index end) {
            const std::lock_guard lock(mutex);
            ranges.emplace_back(begin, end);
          },
          block);
      std::sort(ranges.begin(), ranges.end());
      REQUIRE(ranges.size() == block_count(most, block));
      CHECK(ranges.front().first == 0);
      CHECK(ranges.back().second == most);
      for (std::size_t i = 1; i < ranges.size(); ++i)
        REQUIRE(ranges[i].first == ranges[i - 1].second);
    }
  }
}

TEST_CASE("the scalar entries that a direct solver numbers are counted with 64 bits") {
  using Part = EigenMatrix::Part;
  CHECK(EigenMatrix::entries_of(Part::all, 5, 3, 2) == 20);
  CHECK(EigenMatrix::entries_of(Part::lower, 5, 3, 2) == 1 * 4 + 3 * 3);
  // A mesh of a million nodes fits; 16 entries a row, 3 by 3 each.
  CHECK(EigenMatrix::entries_of(Part::all, 16'000'000, 1'000'000, 3) == 144'000'000);
  // Thirty million nodes: 9 times 480 million does not, half of it does just not either.
  CHECK_THROWS_AS(EigenMatrix::entries_of(Part::all, 480'000'000, 30'000'000, 3), UsageError);
  CHECK_THROWS_AS(EigenMatrix::entries_of(Part::lower, 480'000'000, 30'000'000, 3), UsageError);
  CHECK(EigenMatrix::entries_of(Part::lower, 460'000'000, 30'000'000, 3) == 2'115'000'000);
}
