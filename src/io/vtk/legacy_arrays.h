#pragma once

#include <optional>

#include "io/text/source.h"

namespace winslow::io::vtk {

/// Type of the numbers of a legacy array.
struct NumberType {
  enum class Kind : std::uint8_t { floating, signed_integer, unsigned_integer, bit, text };
  Kind kind;
  std::size_t bytes;
};
std::optional<NumberType> number_type(std::string_view name);

/// Reads the arrays of a legacy file: numbers apart by white space, or big-endian bytes.
class LegacyArrays {
 public:
  explicit LegacyArrays(Scanner& scan) : scan_(scan) {}

  bool binary() const { return binary_; }
  void set_binary(bool binary) { binary_ = binary; }
  /// Next word of this line as a type. Throws InputError.
  NumberType type();
  /// Checks a count read by the caller against the bytes left.
  Index count(const Expected& expected, const NumberType& type, std::size_t numbers_each);

  /// Reads numbers; `places`, if given, gets the byte offset of each.
  std::vector<double> numbers(std::size_t n, NumberType type, const Expected& expected,
                              std::vector<std::size_t>* places = nullptr);
  std::vector<std::int64_t> integers(std::size_t n, NumberType type, const Expected& expected,
                                     std::vector<std::size_t>* places = nullptr);
  /// Skips n strings.
  void skip_strings(std::size_t n, const Expected& expected);

 private:
  void begin_bytes(std::size_t n, NumberType type, const Expected& expected);

  Scanner& scan_;
  bool binary_ = false;
};

}  // namespace winslow::io::vtk
