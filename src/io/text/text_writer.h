#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/text/numbers.h"

namespace winslow::io {

/// Buffers text on its way to a stream; numbers come out the same in every locale.
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
  /// Bytes of a value as they lie in memory.
  template <class Value>
  void raw(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    buffer_.append(reinterpret_cast<const char*>(&value), sizeof value);
    drain();
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
