#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/types.h"
#include "io/text/source.h"

namespace winslow::io {

/// What a scanner should find, spelt out only when it does not: "x of node 57 of 100".
struct Expected {
  const char* what;
  Index index = -1;  ///< counted from 0; printed from 1
  Index count = -1;
  std::string text() const;
};

/// Walks over the text of a source: words, numbers and lines, with errors that name the place.
class Scanner {
 public:
  explicit Scanner(const Source& source, std::size_t offset = 0)
      : source_(source), text_(source.text()), position_(offset) {}
  /// Sees nothing at or after `end`.
  Scanner(const Source& source, std::size_t offset, std::size_t end)
      : source_(source), text_(source.text().substr(0, end)), position_(offset) {}

  const Source& source() const { return source_; }
  std::size_t offset() const { return position_; }
  void seek(std::size_t offset) { position_ = offset; }
  bool at_end() const { return position_ >= text_.size(); }
  std::size_t bytes_left() const { return at_end() ? 0 : text_.size() - position_; }

  /// Rest of this line without its end ("\n" or "\r\n"); goes to the next line.
  std::string_view line();
  /// Skips white space over any number of lines.
  void skip_space();
  /// Next word of this line; empty at its end.
  std::string_view word();
  /// Next word, over line ends; empty at the end of the file.
  std::string_view next_word() {
    skip_space();
    return word();
  }

  /// Next word of this line as a number. Throws InputError.
  std::int64_t integer(const Expected& expected);
  double number(const Expected& expected);
  /// An integer that fits an Index and is not negative.
  Index index(const Expected& expected);
  /// A number of things that follow and take at least `bytes_each` bytes each: never more than the
  /// rest of the file can hold, so that a forged header cannot make us allocate without limit.
  Index count(const Expected& expected, std::size_t bytes_each);

  /// Goes to the next line; anything but white space before it is an error.
  void end_line(const Expected& expected);

  /// Throws "found <the word>, expected ..." at the word (an empty word is a line's or file's end).
  [[noreturn]] void fail(std::string_view found, const Expected& expected) const;
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const;

 private:
  const Source& source_;
  std::string_view text_;
  std::size_t position_;
};

/// Without white space at both ends.
std::string_view trimmed(std::string_view text);
/// Checks a count against the bytes that are left (see Scanner::count). Throws InputError.
Index checked_count(const Source& source, std::size_t offset, std::int64_t count,
                    std::size_t bytes_each, std::size_t bytes_left, const Expected& expected);

}  // namespace winslow::io
