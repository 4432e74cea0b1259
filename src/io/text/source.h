#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "core/types.h"
#include "io/text/numbers.h"

namespace winslow::io {

/// The bytes of an input file. Names places in the file for error messages.
class Source {
 public:
  /// Reads a whole file, decompresses gzip and removes a byte order mark. Throws InputError: no
  /// such file, a directory, not readable, empty.
  static Source load(const std::filesystem::path& path);
  Source(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

  const std::string& name() const { return name_; }
  /// Reads another file like load() and appends it, for meshes in several files. Invalidates views
  /// into text().
  struct Range {
    std::size_t begin, end;
  };
  Range append(const std::filesystem::path& path);
  std::string_view text() const { return bytes_; }
  /// Offset in the file of a view into text().
  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - bytes_.data());
  }

  /// Marks the (first) file as binary from this offset: places are then named by byte instead of by
  /// line.
  void set_binary_from(std::size_t offset) { binary_from_ = offset; }
  /// The same for a file that append() has read.
  void set_binary(const Range& file, std::size_t offset);
  /// Sets the part being read, for files that have named parts ("/Base/Zone/ZoneBC" of CGNS)
  /// instead of lines. From now on places are named by this part.
  void set_part(std::string part) { part_ = std::move(part); }

  /// "FILE:LINE" (lines count from 1), "FILE: byte N" (bytes count from 0) or "FILE: PART".
  std::string where(std::size_t offset) const;
  /// The same without the name of the file: "line 12", "byte 84", "/Base/Zone".
  std::string place(std::size_t offset) const;
  /// Throws InputError "FILE:LINE: message".
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;
  /// Throws InputError "FILE:LINE: found FOUND, expected EXPECTED".
  [[noreturn]] void fail(std::size_t offset, const std::string& found,
                         const std::string& expected) const;

 private:
  std::string name_;
  std::string bytes_;
  std::size_t binary_from_ = std::string::npos;
  struct Part {
    std::size_t begin;
    std::string name;
    std::size_t binary_from = std::string::npos;
  };
  std::vector<Part> appended_;
  std::string part_;
};

/// Prepares a piece of a file for a message: quotes and shortens it, removes control characters.
std::string in_quotes(std::string_view text);

/// What a scanner expects; the text is made only for an error: "x of node 57 of 100".
struct Expected {
  const char* what;
  Index index = -1;  ///< counted from 0; printed from 1
  Index count = -1;
  std::string text() const;
};

/// Reads words, numbers and lines from the text of a source; errors name the place.
class Scanner {
 public:
  explicit Scanner(const Source& source, std::size_t offset = 0)
      : source_(source), text_(source.text()), position_(offset) {}
  /// Reads only up to `end`.
  Scanner(const Source& source, std::size_t offset, std::size_t end)
      : source_(source), text_(source.text().substr(0, end)), position_(offset) {}

  const Source& source() const { return source_; }
  std::size_t offset() const { return position_; }
  void seek(std::size_t offset) { position_ = offset; }
  bool at_end() const { return position_ >= text_.size(); }
  std::size_t bytes_left() const { return at_end() ? 0 : text_.size() - position_; }

  /// Returns the rest of this line without its end ("\n" or "\r\n"); moves to the next line.
  std::string_view line();
  /// Skips white space, including line ends.
  void skip_space();
  /// Next word of this line; empty at its end.
  std::string_view word();
  /// Next word, also on a later line; empty at the end of the file.
  std::string_view next_word() {
    skip_space();
    return word();
  }

  /// Next word of this line as a number. Throws InputError.
  std::int64_t integer(const Expected& expected) { return parsed<std::int64_t>(expected); }
  double number(const Expected& expected) { return parsed<double>(expected); }
  /// An integer that fits an Index and is not negative.
  Index index(const Expected& expected);
  /// Reads the count of following items of at least `bytes_each` bytes each. Throws InputError if
  /// the rest of the file cannot hold them, so that a forged header cannot cause huge allocations.
  Index count(const Expected& expected, std::size_t bytes_each);

  /// The next number of a binary file, of that kind. Throws InputError.
  template <class Number>
  Number bytes(const BinaryNumber& kind, bool big_endian, const Expected& expected) {
    if (bytes_left() < kind.bytes)
      source_.fail(source_.text().size(), "the end of the file", expected.text());
    position_ += kind.bytes;
    return number_at<Number>(text_.data() + position_ - kind.bytes, kind, big_endian);
  }

  /// Moves to the next line. Throws InputError if the rest of this line is not white space.
  void end_line(const Expected& expected);

  /// Throws "found <the word>, expected ..." at the word (empty: the end of the line or file).
  [[noreturn]] void fail(std::string_view found, const Expected& expected) const;
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const;

 private:
  template <class Number>
  Number parsed(const Expected& expected) {
    const auto found = word();
    const auto value = parse<Number>(found);
    if (!value) fail(found, expected);
    return *value;
  }

  const Source& source_;
  std::string_view text_;
  std::size_t position_;
};

/// Removes white space at both ends.
std::string_view trimmed(std::string_view text);
/// Offset of the first character of the line in which `offset` lies.
std::size_t line_begin(std::string_view text, std::size_t offset);
/// Joins text(item) of all items: "1, 2, 4".
template <class Items, class Text>
std::string list_of(const Items& items, const Text& text) {
  std::string list;
  for (const auto& item : items) list.append(list.empty() ? "" : ", ").append(text(item));
  return list;
}
/// A name as one word: '_' replaces blanks, control characters and `others`.
std::string as_word(std::string name, std::string_view others = {});
/// A name that fits in a line: as as_word(), but keeps blanks.
std::string within_line(std::string name, std::string_view others = {});
/// Converts ASCII letters to lower case.
std::string lower_case(std::string_view text);
/// Checks a count against the remaining bytes (see Scanner::count). Throws InputError.
Index checked_count(const Source& source, std::size_t offset, std::int64_t count,
                    std::size_t bytes_each, std::size_t bytes_left, const Expected& expected);

}  // namespace winslow::io
