#pragma once

#include <cstring>
#include <filesystem>
#include <ostream>
#include <type_traits>

#include "core/mesh/element_type.h"

namespace winslow::gui {

/// FNV-1a, 64 bits.
class Checksum {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      value_ = (value_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ull;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

/// Writes numbers and text as in memory, followed by a checksum. ArchiveReader has the same members
/// for reading, so that one list of fields serves both.
class ArchiveWriter {
 public:
  explicit ArchiveWriter(std::ostream& out) : out_(out) {}
  template <class Number>
  void number(const Number& value) {
    static_assert(std::is_trivially_copyable_v<Number>);
    bytes(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Writes the values one after another.
  template <class... Numbers>
  void each(const Numbers&... values) {
    (number(values), ...);
  }
  template <class Number>
  void numbers(const std::vector<Number>& values) {
    numbers(std::span<const Number>(values));
  }
  template <class Number>
  void numbers(std::span<const Number> values) {
    static_assert(std::is_trivially_copyable_v<Number>);
    number<std::uint64_t>(values.size());
    bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void faces(const std::vector<Face>& values) {
    list(values, [](auto& a, const Face& face) {
      a.numbers(std::span<const Index>(face.begin(), face.end()));
    });
  }
  void text(std::string_view text) {
    number<std::uint64_t>(text.size());
    bytes(text.data(), text.size());
  }
  /// Writes a list; `fields` writes one of its values.
  template <class Value, class Fields>
  void list(const std::vector<Value>& values, const Fields& fields) {
    number<std::uint64_t>(values.size());
    for (const Value& value : values) fields(*this, value);
  }
  void finish() {
    const std::uint64_t sum = sum_.value();
    out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  }

 private:
  void bytes(const char* data, std::size_t count) {
    sum_.add(data, count);
    out_.write(data, static_cast<std::streamsize>(count));
  }
  std::ostream& out_;
  Checksum sum_;
};

/// Reads what ArchiveWriter wrote. Throws InputError if the bytes end early or a length exceeds the
/// remaining bytes.
class ArchiveReader {
 public:
  ArchiveReader(std::string_view bytes, const std::filesystem::path& path)
      : left_(bytes), path_(path) {}
  template <class Number>
  void number(Number& value) {
    static_assert(std::is_trivially_copyable_v<Number>);
    const std::string_view bytes = next_bytes(sizeof value);
    if constexpr (std::is_same_v<Number, bool>) {
      if (bytes[0] != 0 && bytes[0] != 1) fail("neither yes nor no");
    }
    std::memcpy(&value, bytes.data(), sizeof value);
  }
  template <class... Numbers>
  void each(Numbers&... values) {
    (number(values), ...);
  }
  template <class Number>
  void numbers(std::vector<Number>& values) {
    const std::size_t count = length(sizeof(Number));
    values.resize(count);
    if (count > 0)
      std::memcpy(values.data(), next_bytes(count * sizeof(Number)).data(), count * sizeof(Number));
  }
  /// A face of fewer than two nodes, which a damaged file may have, becomes one without nodes.
  void faces(std::vector<Face>& values) {
    std::vector<Index> nodes;
    list(values, [&](auto& a, Face& face) {
      a.numbers(nodes);
      face = nodes.size() < 2 ? Face() : Face(std::span<const Index>(nodes));
    });
  }
  void text(std::string& text) { text = next_bytes(length(1)); }
  template <class Value, class Fields>
  void list(std::vector<Value>& values, const Fields& fields) {
    values.resize(length(1));
    for (Value& value : values) fields(*this, value);
  }
  bool empty() const { return left_.empty(); }
  [[noreturn]] void fail(const std::string& found) const;

 private:
  /// Reads the count of the items that follow, each of at least `size` bytes.
  std::size_t length(std::size_t size);
  std::string_view next_bytes(std::size_t count);

  std::string_view left_;
  const std::filesystem::path& path_;
};

/// Verifies the checksum at the end of a file and returns the bytes before it. Throws InputError.
std::string checked_content(const std::filesystem::path& path);

}  // namespace winslow::gui
