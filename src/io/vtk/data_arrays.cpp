#include "io/vtk/data_arrays.h"

#include <charconv>
#include <cmath>
#include <set>

#include "io/text/source.h"

namespace winslow::io::vtk {
namespace {

struct LegacyType {
  std::string_view name;
  ValueType type;
};

/// The first name of a type is the one to write.
constexpr std::array<LegacyType, 19> legacy_types{{
    {"bit", {ValueKind::bit, 1}},
    {"unsigned_char", {ValueKind::unsigned_integer, 1}},
    {"char", {ValueKind::signed_integer, 1}},
    {"signed_char", {ValueKind::signed_integer, 1}},
    {"unsigned_short", {ValueKind::unsigned_integer, 2}},
    {"short", {ValueKind::signed_integer, 2}},
    {"unsigned_int", {ValueKind::unsigned_integer, 4}},
    {"int", {ValueKind::signed_integer, 4}},
    {"vtktypeuint64", {ValueKind::unsigned_integer, 8}},
    {"vtktypeint64", {ValueKind::signed_integer, 8}},
    {"unsigned_long", {ValueKind::unsigned_integer, 8}},
    {"long", {ValueKind::signed_integer, 8}},
    {"unsigned_long_long", {ValueKind::unsigned_integer, 8}},
    {"long_long", {ValueKind::signed_integer, 8}},
    {"vtktypeint32", {ValueKind::signed_integer, 4}},
    // Legacy files hold ids as 32-bit integers, whatever their width in memory.
    {"vtkidtype", {ValueKind::signed_integer, 4}},
    {"float", {ValueKind::floating, 4}},
    {"double", {ValueKind::floating, 8}},
    {"string", {ValueKind::text, 1}},
}};

/// Names of winslow's own arrays, which hold what a mesh says itself.
bool is_own(std::string_view name) {
  return name == "marker" || name == "region" || name.starts_with("marker:") ||
         name.starts_with("region:");
}

template <class Number>
void append_bytes(std::string& bytes, Number value, std::size_t width) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  static_assert(std::endian::native == std::endian::little, "the first bytes are the low ones");
  bytes.append(raw.data(), width);
}

bool append_floating(std::string& bytes, std::size_t width, std::string_view word) {
  if (width == 4) {
    // Not by way of a double, which would round twice.
    float single = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), single);
    if (error == std::errc() && end == word.data() + word.size()) {
      append_bytes(bytes, single, width);
      return true;
    }
  }
  const auto value = parse_number(word);
  if (!value) return false;
  if (width == 4)
    append_bytes(bytes, static_cast<float>(*value), width);
  else
    append_bytes(bytes, *value, width);
  return true;
}

/// The bits of a whole number that fits a type.
std::optional<std::uint64_t> whole_number(const ValueType& type, std::string_view word) {
  const auto bits = 8 * type.bytes;
  std::uint64_t large = 0;
  if (type.kind == ValueKind::unsigned_integer && bits == 64) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), large);
    if (error == std::errc() && end == word.data() + word.size()) return large;
  }
  auto value = parse_integer(word);
  if (!value) {
    const auto number = parse_number(word);
    constexpr double exact = 9007199254740992;  // 2^53
    if (!number || !(std::abs(*number) <= exact) || *number != std::trunc(*number))
      return std::nullopt;
    value = static_cast<std::int64_t>(*number);
  }
  const std::int64_t most = std::numeric_limits<std::int64_t>::max();
  const bool is_signed = type.kind == ValueKind::signed_integer;
  const std::int64_t high = is_signed    ? most >> (64 - bits)
                            : bits == 64 ? most
                                         : most >> (63 - bits);
  const std::int64_t low = is_signed ? -high - 1 : 0;
  if (*value < low || *value > high) return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

}  // namespace

std::optional<ValueType> xml_type(std::string_view name) {
  if (name == "Float32") return ValueType{ValueKind::floating, 4};
  if (name == "Float64") return ValueType{ValueKind::floating, 8};
  if (name == "String") return ValueType{ValueKind::text, 1};
  if (name == "Bit") return ValueType{ValueKind::bit, 1};
  for (const ValueKind kind : {ValueKind::signed_integer, ValueKind::unsigned_integer}) {
    for (const std::size_t bytes : {1U, 2U, 4U, 8U}) {
      const ValueType type{kind, bytes};
      if (xml_name(type) == name) return type;
    }
  }
  return std::nullopt;
}

std::string xml_name(const ValueType& type) {
  if (type.kind == ValueKind::text) return "String";
  if (type.kind == ValueKind::bit) return "Bit";
  const char* kind = type.kind == ValueKind::floating         ? "Float"
                     : type.kind == ValueKind::signed_integer ? "Int"
                                                              : "UInt";
  return kind + std::to_string(8 * type.bytes);
}

std::optional<ValueType> legacy_type(std::string_view name) {
  const std::string lower = lower_case(name);
  for (const LegacyType& known : legacy_types)
    if (known.name == lower) return known.type;
  return std::nullopt;
}

std::string_view legacy_name(const ValueType& type) {
  for (const LegacyType& known : legacy_types)
    if (known.type == type) return known.name;
  return "double";
}

std::size_t DataArray::value_count() const {
  return type.kind == ValueKind::bit ? bits : bytes.size() / type.bytes;
}

double DataArray::number(std::size_t value) const {
  if (type.kind == ValueKind::bit) return bit_at(bytes, value) ? 1 : 0;
  const char* first = bytes.data() + value * type.bytes;
  if (type == ValueType{ValueKind::unsigned_integer, 8})
    return static_cast<double>(unsigned_at(first, 8, false));
  return number_at<double>(first, type.number(), false);
}

std::string DataArrays::names() const {
  constexpr std::size_t few = 5;
  std::set<std::string> all;
  for (const auto* list : {&points, &cells, &field})
    for (const DataArray& array : *list)
      if (!is_own(array.name)) all.insert(array.name);
  std::string text;
  std::size_t said = 0;
  for (const std::string& name : all) {
    if (said == few) break;
    text += (said++ == 0 ? "" : ", ") + (name.empty() ? "one without a name" : name);
  }
  if (all.size() > said) text += " and " + std::to_string(all.size() - said) + " more";
  return text;
}

bool append_value(std::string& bytes, const ValueType& type, std::string_view word) {
  if (type.kind == ValueKind::floating) return append_floating(bytes, type.bytes, word);
  if (type.kind == ValueKind::text) {
    // A character's number; those of signed characters may be negative.
    const auto code = parse_integer(word);
    if (!code || *code < -128 || *code > 255) return false;
    bytes += static_cast<char>(*code);
    return true;
  }
  const auto value = whole_number(
      type.kind == ValueKind::bit ? ValueType{ValueKind::unsigned_integer, 1} : type, word);
  if (!value || (type.kind == ValueKind::bit && *value > 1)) return false;
  append_bytes(bytes, *value, type.bytes);
  return true;
}

void append_text(std::string& text, const DataArray& array, std::size_t value) {
  const ValueType& type = array.type;
  if (type.kind == ValueKind::bit) {
    text += bit_at(array.bytes, value) ? '1' : '0';
    return;
  }
  const char* first = array.bytes.data() + value * type.bytes;
  if (type.kind == ValueKind::text)
    return append_number(text, static_cast<std::int64_t>(static_cast<signed char>(*first)));
  if (type.kind == ValueKind::unsigned_integer) {
    text += std::to_string(unsigned_at(first, type.bytes, false));
  } else if (type.kind == ValueKind::signed_integer) {
    append_number(text, number_at<std::int64_t>(first, type.number(), false));
  } else if (type.bytes == 4 && std::isfinite(array.number(value))) {
    std::array<char, 32> shortest{};
    const auto single =
        std::bit_cast<float>(static_cast<std::uint32_t>(unsigned_at(first, 4, false)));
    const auto end = std::to_chars(shortest.data(), shortest.data() + shortest.size(), single).ptr;
    text.append(shortest.data(), end);
  } else {
    append_number(text, array.number(value));
  }
}

void write_lines(TextWriter& out, const DataArray& array, std::size_t per_line) {
  const std::size_t count = array.value_count();
  std::string word;
  for (std::size_t i = 0; i < count; ++i) {
    word.clear();
    append_text(word, array, i);
    out << word << ((i + 1) % per_line == 0 || i + 1 == count ? '\n' : ' ');
  }
}

std::string packed_bits(const std::string& values) {
  std::string bytes((values.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto mask = static_cast<unsigned char>(0x80U >> (i % 8));
    if (values[i] != 0)
      bytes[i / 8] = static_cast<char>(static_cast<unsigned char>(bytes[i / 8]) | mask);
  }
  return bytes;
}

bool bit_at(const std::string& bytes, std::size_t index) {
  return (static_cast<unsigned char>(bytes[index / 8]) & (0x80U >> (index % 8))) != 0;
}

void swap_bytes(std::string& bytes, std::size_t width) {
  if (width < 2) return;
  for (auto first = bytes.begin(); bytes.end() - first >= static_cast<std::ptrdiff_t>(width);
       first += static_cast<std::ptrdiff_t>(width))
    std::reverse(first, first + static_cast<std::ptrdiff_t>(width));
}

DataArray integer_array(std::string name, const std::vector<int>& values) {
  DataArray array{std::move(name), {ValueKind::signed_integer, 4}};
  for (const int value : values) append_bytes(array.bytes, value, 4);
  return array;
}

}  // namespace winslow::io::vtk
