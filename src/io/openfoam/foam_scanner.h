#pragma once

#include "io/text/source.h"

namespace winslow::io::openfoam {

/// The words of one file of OpenFOAM: comments are skipped, and each of ( ) { } ; [ ] is a word.
class FoamScanner {
 public:
  FoamScanner(const Source& source, Source::Range range)
      : source_(source), scan_(source, range.begin, range.end), range_(range) {}

  /// Offset of the next word.
  std::size_t offset();
  /// Behind the last word.
  std::size_t position() const { return scan_.offset(); }
  std::size_t bytes_left() const { return scan_.bytes_left(); }
  /// Empty at the end of the file.
  std::string_view next();
  std::string_view peek();
  /// Throws InputError for another word.
  void expect(std::string_view word);

  std::int64_t integer(const Expected& expected);
  double number(const Expected& expected);
  /// The length of a list, whose entries take at least so many bytes each.
  Index count(const Expected& expected, std::size_t bytes_each);

  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    scan_.fail(word, expected);
  }

 private:
  void skip();

  const Source& source_;
  Scanner scan_;
  Source::Range range_;
};

/// Reads the entry FoamFile, if there is one. Throws InputError for binary files.
void read_foam_header(FoamScanner& scan);

}  // namespace winslow::io::openfoam
