#pragma once

#include <bit>
#include <cstring>

#include "io/text/scanner.h"

namespace winslow::io::gmsh {

static_assert(std::endian::native == std::endian::little,
              "binary MSH files are read and written as they lie in memory");

/// The numbers of a section, from text or from bytes: one parser serves both.
class ValueReader {
 public:
  ValueReader(Scanner& scan, bool binary) : scan_(scan), binary_(binary) {}

  bool binary() const { return binary_; }
  std::size_t offset() const { return scan_.offset(); }

  /// Start of a record: in text the next line that is not blank.
  std::size_t begin() {
    if (!binary_) scan_.skip_space();
    return scan_.offset();
  }
  void end(const Expected& expected) {
    if (!binary_) scan_.end_line(expected);
  }

  int integer(const Expected& expected) {
    if (binary_) return take<std::int32_t>(expected);
    const std::size_t at = scan_.offset();
    const auto value = scan_.integer(expected);
    if (value != static_cast<int>(value))
      scan_.source().fail(at, std::to_string(value), expected.text());
    return static_cast<int>(value);
  }
  std::int64_t size(const Expected& expected) {
    return binary_ ? take<std::int64_t>(expected) : scan_.integer(expected);
  }
  double real(const Expected& expected) {
    return binary_ ? take<double>(expected) : scan_.number(expected);
  }
  /// A count of things of at least `text_bytes` (in text) or `binary_bytes` bytes each.
  Index count(const Expected& expected, std::size_t text_bytes, std::size_t binary_bytes) {
    const std::size_t at = scan_.offset();
    const auto n = size(expected);
    return checked_count(scan_.source(), at, n, binary_ ? binary_bytes : text_bytes,
                         scan_.bytes_left(), expected);
  }

 private:
  template <class Value>
  Value take(const Expected& expected) {
    if (scan_.bytes_left() < sizeof(Value)) {
      scan_.source().fail(scan_.source().text().size(), "the end of the file", expected.text());
    }
    Value value;
    std::memcpy(&value, scan_.source().text().data() + scan_.offset(), sizeof value);
    scan_.seek(scan_.offset() + sizeof value);
    return value;
  }

  Scanner& scan_;
  bool binary_;
};

}  // namespace winslow::io::gmsh
