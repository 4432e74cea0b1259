#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace winslow::io {

/// Parses the whole text as an integer ("+7" is accepted); nothing if it is none or too large.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Parses the whole text as a number, rounded to the nearest double, in any locale. Accepts "nan",
/// "inf" and Fortran's "1.5D+03". Underflow gives zero or a subnormal, overflow infinity.
std::optional<double> parse_number(std::string_view text);

/// parse_integer() or parse_number().
template <class Number>
std::optional<Number> parse(std::string_view text) {
  if constexpr (std::is_integral_v<Number>)
    return parse_integer(text);
  else
    return parse_number(text);
}

/// How a binary file holds a number.
struct BinaryNumber {
  bool floating = false;
  bool is_signed = false;
  std::size_t bytes = 0;
};
/// The unsigned integer in `count` bytes.
std::uint64_t unsigned_at(const char* bytes, std::size_t count, bool big_endian);
/// Reads a number of that kind.
template <class Number>
Number number_at(const char* bytes, const BinaryNumber& kind, bool big_endian) {
  const std::uint64_t raw = unsigned_at(bytes, kind.bytes, big_endian);
  if (kind.floating && kind.bytes == 8) return static_cast<Number>(std::bit_cast<double>(raw));
  if (kind.floating)
    return static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  const auto shift = static_cast<unsigned>(kind.is_signed ? 64 - 8 * kind.bytes : 0);
  return static_cast<Number>(static_cast<std::int64_t>(raw << shift) >> shift);
}

/// Shortest decimal text that parse_number turns into the same double.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

/// Buffered output of text to a stream; numbers do not depend on the locale.
class TextWriter {
 public:
  explicit TextWriter(std::ostream& out) : out_(out) { buffer_.reserve(capacity + 256); }
  ~TextWriter() { flush(); }
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text) {
    buffer_ += text;
    return drain();
  }
  TextWriter& operator<<(char c) {
    buffer_ += c;
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> TextWriter& operator<<(Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
      append_number(buffer_, static_cast<double>(value));
    } else {
      append_number(buffer_, static_cast<std::int64_t>(value));
    }
    return drain();
  }
  /// Writes the bytes of a value in their memory order.
  template <class Value>
  void raw(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    buffer_.append(reinterpret_cast<const char*>(&value), sizeof value);
    drain();
  }

  /// The same in the given byte order.
  template <class Number>
  void raw(Number value, bool big_endian) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (big_endian == (std::endian::native == std::endian::little))
      std::reverse(bytes.begin(), bytes.end());
    raw(bytes);
  }

  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  static constexpr std::size_t capacity = 1 << 16;
  TextWriter& drain() {
    if (buffer_.size() >= capacity) flush();
    return *this;
  }

  std::ostream& out_;
  std::string buffer_;
};

}  // namespace winslow::io
