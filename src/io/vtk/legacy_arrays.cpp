#include "io/vtk/legacy_arrays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/text/numbers.h"

namespace winslow::io::vtk {
namespace {

using Kind = NumberType::Kind;

std::uint64_t big_endian(const char* bytes, std::size_t n) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < n; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::int64_t integer_at(const char* bytes, NumberType type) {
  const std::uint64_t raw = big_endian(bytes, type.bytes);
  if (type.kind == Kind::unsigned_integer || type.bytes == 8) return static_cast<std::int64_t>(raw);
  const unsigned shift = static_cast<unsigned>(64 - 8 * type.bytes);
  return static_cast<std::int64_t>(raw << shift) >> shift;
}

double number_at(const char* bytes, NumberType type) {
  if (type.kind != Kind::floating) return static_cast<double>(integer_at(bytes, type));
  const std::uint64_t raw = big_endian(bytes, type.bytes);
  if (type.bytes == 8) return std::bit_cast<double>(raw);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
}

}  // namespace

std::optional<NumberType> number_type(std::string_view name) {
  struct Named {
    std::string_view name;
    NumberType type;
  };
  static constexpr std::array<Named, 19> types{{
      {"bit", {Kind::bit, 1}},
      {"unsigned_char", {Kind::unsigned_integer, 1}},
      {"char", {Kind::signed_integer, 1}},
      {"signed_char", {Kind::signed_integer, 1}},
      {"unsigned_short", {Kind::unsigned_integer, 2}},
      {"short", {Kind::signed_integer, 2}},
      {"unsigned_int", {Kind::unsigned_integer, 4}},
      {"int", {Kind::signed_integer, 4}},
      {"unsigned_long", {Kind::unsigned_integer, 8}},
      {"long", {Kind::signed_integer, 8}},
      {"unsigned_long_long", {Kind::unsigned_integer, 8}},
      {"long_long", {Kind::signed_integer, 8}},
      {"vtktypeint64", {Kind::signed_integer, 8}},
      {"vtktypeuint64", {Kind::unsigned_integer, 8}},
      {"vtktypeint32", {Kind::signed_integer, 4}},
      // Legacy files hold ids as 32-bit integers, however wide they are in memory.
      {"vtkIdType", {Kind::signed_integer, 4}},
      {"float", {Kind::floating, 4}},
      {"double", {Kind::floating, 8}},
      {"string", {Kind::text, 1}},
  }};
  std::string lower(name);
  if (name != "vtkIdType") {
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  }
  for (const Named& known : types) {
    if (known.name == lower) return known.type;
  }
  return std::nullopt;
}

NumberType LegacyArrays::type() {
  const auto word = scan_.word();
  const auto found = number_type(word);
  if (!found) scan_.fail(word, "a type such as float, double or int");
  return *found;
}

Index LegacyArrays::count(const Expected& expected, const NumberType& type,
                          std::size_t numbers_each) {
  return scan_.count(
      expected, std::max<std::size_t>(1, binary_ ? numbers_each * type.bytes : numbers_each * 2));
}

void LegacyArrays::begin_bytes(std::size_t n, NumberType type, const Expected& expected) {
  const std::size_t size = type.kind == Kind::bit ? (n + 7) / 8 : n * type.bytes;
  if (n > scan_.bytes_left() || size > scan_.bytes_left()) {
    scan_.source().fail(scan_.source().text().size(), "the end of the file", expected.text());
  }
}

std::vector<double> LegacyArrays::numbers(std::size_t n, NumberType type, const Expected& expected,
                                          std::vector<std::size_t>* places) {
  std::vector<double> values;
  if (type.kind == Kind::text) {
    skip_strings(n, expected);
    return values;
  }
  if (binary_) begin_bytes(type.kind == Kind::bit ? (n + 7) / 8 : n, type, expected);
  if (n / 2 > scan_.bytes_left() + 1 && !binary_) {
    scan_.source().fail(scan_.offset(), "too few numbers", expected.text());
  }
  if (binary_ && type.kind == Kind::bit) {
    scan_.seek(scan_.offset() + (n + 7) / 8);
    return values;
  }
  values.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (binary_) {
      if (places != nullptr) places->push_back(scan_.offset());
      values.push_back(number_at(scan_.source().text().data() + scan_.offset(), type));
      scan_.seek(scan_.offset() + type.bytes);
      continue;
    }
    const auto word = scan_.next_word();
    const auto value = parse_number(word);
    if (!value) scan_.fail(word, expected);
    if (places != nullptr) places->push_back(scan_.source().offset_of(word));
    values.push_back(*value);
  }
  return values;
}

std::vector<std::int64_t> LegacyArrays::integers(std::size_t n, NumberType type,
                                                 const Expected& expected,
                                                 std::vector<std::size_t>* places) {
  if (type.kind != Kind::signed_integer && type.kind != Kind::unsigned_integer) {
    scan_.source().fail(scan_.offset(), "an array that is not of integers", expected.text());
  }
  std::vector<std::int64_t> values;
  if (binary_) begin_bytes(n, type, expected);
  values.reserve(std::min(n, scan_.bytes_left()));
  for (std::size_t i = 0; i < n; ++i) {
    if (binary_) {
      if (places != nullptr) places->push_back(scan_.offset());
      values.push_back(integer_at(scan_.source().text().data() + scan_.offset(), type));
      scan_.seek(scan_.offset() + type.bytes);
      continue;
    }
    const auto word = scan_.next_word();
    const auto value = parse_integer(word);
    if (!value) scan_.fail(word, expected);
    if (places != nullptr) places->push_back(scan_.source().offset_of(word));
    values.push_back(*value);
  }
  return values;
}

/// In binary, the two top bits of the first byte tell how many bytes hold the length.
void LegacyArrays::skip_strings(std::size_t n, const Expected& expected) {
  const auto text = scan_.source().text();
  for (std::size_t i = 0; i < n; ++i) {
    if (scan_.at_end()) scan_.source().fail(text.size(), "the end of the file", expected.text());
    if (!binary_) {
      scan_.line();
      continue;
    }
    const auto first = static_cast<unsigned char>(text[scan_.offset()]);
    const std::size_t width = std::size_t{1} << (3 - (first >> 6));
    if (scan_.bytes_left() < width) {
      scan_.source().fail(text.size(), "the end of the file", expected.text());
    }
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - 8 * width + 2);
    const std::uint64_t length = big_endian(text.data() + scan_.offset(), width) & mask;
    if (length > scan_.bytes_left() - width) {
      scan_.source().fail(scan_.offset(), "a string longer than the file", expected.text());
    }
    scan_.seek(scan_.offset() + width + static_cast<std::size_t>(length));
  }
}

}  // namespace winslow::io::vtk
