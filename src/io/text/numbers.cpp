#include "io/text/numbers.h"

#include <charconv>
#include <limits>

namespace winslow::io {
namespace {

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

/// Value of an out-of-range number, for which from_chars gives none: 0 or infinity by the sign of
/// the exponent.
double out_of_range_value(std::string_view text) {
  const auto exponent = text.find_first_of("eE");
  const bool negative = text.front() == '-';
  const bool tiny = exponent != std::string_view::npos
                        ? text.find('-', exponent) != std::string_view::npos
                        : text.find_first_of("123456789") > text.find('.');
  const double magnitude = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  return negative ? -magnitude : magnitude;
}

std::optional<double> parse_decimal(std::string_view text) {
  text = without_plus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return out_of_range_value(text);
  return value;
}

/// "1.5D+03": Fortran's double precision.
std::optional<double> parse_fortran(std::string_view text) {
  constexpr std::size_t longest = 64;
  const auto exponent = text.find_first_of("dD");
  if (exponent == std::string_view::npos || text.size() > longest) return std::nullopt;
  std::string decimal(text);
  decimal[exponent] = 'e';
  return parse_decimal(decimal);
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
  text = without_plus(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> parse_number(std::string_view text) {
  const auto value = parse_decimal(text);
  return value ? value : parse_fortran(text);
}

std::uint64_t unsigned_at(const char* bytes, std::size_t count, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = big_endian ? i : count - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  }
  return value;
}

namespace {

template <class Number>
void append(std::string& text, Number value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

}  // namespace

void append_number(std::string& text, double value) { append(text, value); }
void append_number(std::string& text, std::int64_t value) { append(text, value); }

}  // namespace winslow::io
