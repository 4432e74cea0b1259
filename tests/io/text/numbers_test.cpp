#include "io/text/numbers.h"

#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <limits>

#include "support/random.h"

namespace winslow::test {

TEST_CASE("numbers: only whole words, signs, exponents, out of range") {
  CHECK(io::parse_integer("12") == 12);
  CHECK(io::parse_integer("+12") == 12);
  CHECK(io::parse_integer("-12") == -12);
  for (const char* bad : {"", "+", "-", "1.0", "1x", " 1", "+-1", "99999999999999999999"}) {
    CAPTURE(bad);
    CHECK_FALSE(io::parse_integer(bad).has_value());
  }
  CHECK(io::parse_number("1e3") == 1000.0);
  CHECK(io::parse_number("+.5") == 0.5);
  CHECK(io::parse_number("-0.5E-1") == -0.05);
  CHECK(io::parse_number("1.5D+03") == 1500.0);
  CHECK(io::parse_number("-.5d-1") == -0.05);
  CHECK(io::parse_number("1D999") == std::numeric_limits<double>::infinity());
  CHECK(io::parse_number("1e999") == std::numeric_limits<double>::infinity());
  CHECK(io::parse_number("-1e999") == -std::numeric_limits<double>::infinity());
  CHECK(io::parse_number("1e-999") == 0.0);
  CHECK(std::signbit(*io::parse_number("-1e-999")));
  CHECK(std::isnan(*io::parse_number("nan")));
  for (const char* bad :
       {"", ".", "e5", "1,5", "1.5f", "0x10", "--1", "d", "d5", "1d", "1dd5", "1e5d5"}) {
    CAPTURE(bad);
    CHECK_FALSE(io::parse_number(bad).has_value());
  }
}

TEST_CASE("numbers: what is printed is read back to the last bit, in any locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  Random random(11);
  for (int i = 0; i < 10000; ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-300, 300));
    std::string text;
    io::append_number(text, value);
    REQUIRE(io::parse_number(text) == value);
    REQUIRE(text.size() <= 24);
  }
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace winslow::test
