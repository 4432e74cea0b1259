#include "gui/render/ticks.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace winslow::gui;

TEST_CASE("Ticks are round, evenly spaced and inside the range") {
  const auto ticks = nice_ticks(0, 1, 5);
  REQUIRE(ticks.size() == 6);
  for (std::size_t k = 0; k < 6; ++k) CHECK(ticks[k] == doctest::Approx(0.2 * double(k)));

  for (const auto& range : {std::pair{-3.7, 12.1}, {1e-9, 7e-9}, {1e6, 1.00003e6}}) {
    const double low = range.first, high = range.second;
    CAPTURE(low);
    const auto some = nice_ticks(low, high, 6);
    REQUIRE(some.size() >= 3);
    CHECK(some.size() <= 8);
    CHECK(some.front() >= low - 1e-9 * (high - low));
    CHECK(some.back() <= high + 1e-9 * (high - low));
    const double step = some[1] - some[0];
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    const bool round = std::abs(mantissa - 1) < 1e-3 || std::abs(mantissa - 2) < 1e-3 ||
                       std::abs(mantissa - 2.5) < 1e-3 || std::abs(mantissa - 5) < 1e-3;
    CHECK(round);
  }
}

TEST_CASE("A range without extent has no ticks") {
  CHECK(nice_ticks(1, 1, 5).empty());
  CHECK(nice_ticks(2, 1, 5).empty());
  CHECK(nice_ticks(0, std::numeric_limits<double>::infinity(), 5).empty());
  CHECK(nice_ticks(std::nan(""), 1, 5).empty());
}

TEST_CASE("Rounding up gives the next round number and keeps a round one") {
  CHECK(round_up_nicely(1.3) == doctest::Approx(1.5));
  CHECK(round_up_nicely(17) == doctest::Approx(20));
  CHECK(round_up_nicely(0.0071) == doctest::Approx(0.008));
  CHECK(round_up_nicely(9.5) == doctest::Approx(10));
  CHECK(round_up_nicely(2.5) == doctest::Approx(2.5));
}

TEST_CASE("Labels are as short as their neighbours allow") {
  CHECK(format_tick(0.2, 0.2) == "0.2");
  CHECK(format_tick(0.25, 0.25) == "0.25");
  CHECK(format_tick(1, 0.2) == "1.0");
  CHECK(format_tick(-1e-17, 0.2) == "0");
  CHECK(format_tick(100, 50) == "100");
  CHECK(format_tick(2e-7, 1e-7) == "2e-07");
  CHECK(format_tick(3e9, 1e9) == "3e+09");
}

TEST_CASE("Ticks of a logarithmic axis are powers of ten, or 1, 2 and 5 times those") {
  CHECK(log_ticks(1, 1e4, 8) == std::vector<double>{1, 10, 100, 1000, 1e4});
  const auto fine = log_ticks(1, 60, 8);
  REQUIRE(fine.size() == 6);
  CHECK(fine[1] == doctest::Approx(2));
  CHECK(fine[5] == doctest::Approx(50));
  // Of many decades every so many, and all inside.
  for (const int wanted : {2, 3, 5, 8}) {
    const auto many = log_ticks(3e-9, 2e7, wanted);
    CAPTURE(wanted);
    CHECK(many.size() >= 2);
    CHECK(many.size() <= static_cast<std::size_t>(wanted) + 1);
    CHECK(many.front() >= 3e-9);
    CHECK(many.back() <= 2e7);
  }
  CHECK(log_ticks(0, 1, 5).empty());
  CHECK(log_ticks(2, 3, 5) == nice_ticks(2, 3, 5));
  CHECK(format_power(1e-6) == "1e-06");
  CHECK(format_power(20) == "20");
}
