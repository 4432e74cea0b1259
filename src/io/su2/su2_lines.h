#pragma once

#include "io/text/source.h"

namespace winslow::io::su2 {

/// A line of an SU2 file: "KEY= value % comment", or data.
struct Line {
  std::size_t offset = 0;  ///< of its first byte in the source
  std::string_view bytes;  ///< the whole line with its line end
  std::string_view text;   ///< without comment and blanks at both ends
  std::string_view key;    ///< empty: not a keyword line
  std::string_view value;

  bool blank() const { return text.empty(); }
};

/// Splits a line into words.
class LineWords {
 public:
  explicit LineWords(std::string_view text) : rest_(text) {}
  /// The next word; empty at the end of the line.
  std::string_view next();
  /// The text after the last word, without blanks at both ends.
  std::string_view rest() const { return trimmed(rest_); }

 private:
  std::string_view rest_;
};

/// Reads the lines of a zone one by one.
class LineReader {
 public:
  LineReader(const Source& source, std::size_t begin, std::size_t end)
      : source_(source), scan_(source, begin, end), end_(end) {}

  const Source& source() const { return source_; }
  bool at_end() const { return scan_.at_end(); }
  std::size_t offset() const { return scan_.offset(); }
  std::size_t bytes_left() const { return scan_.bytes_left(); }
  void back_to(const Line& line) { scan_.seek(line.offset); }

  Line next();
  /// The next line with data (neither blank nor only a comment). Throws InputError at the end.
  Line next_data(const Expected& expected);

  /// Throws "found <the word>, expected ..." at the word; an empty word stands for the end of the
  /// line.
  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    scan_.fail(word, expected);
  }

 private:
  const Source& source_;
  Scanner scan_;
  std::size_t end_;
};

/// The first lines "KEY=" in a part of a file. Looks for the keyword instead of reading every line:
/// meshes are large, and most have one zone.
std::vector<Line> lines_with(const Source& source, std::size_t begin, std::size_t end,
                             std::string_view key, std::size_t most = std::string::npos);

/// The zones of a file (NZONE=, IZONE=), each from its IZONE= line to the next one's.
struct ZoneList {
  struct Zone {
    int number;
    std::size_t begin, end;
  };
  std::vector<Zone> zones;  ///< never empty
  bool several = false;     ///< false: one zone, which is the whole file

  std::vector<int> numbers() const;
  /// The text before the first zone, then that of each zone.
  std::vector<std::string> blocks(const Source& source) const;
};

/// Throws InputError if NZONE= and IZONE= contradict each other.
ZoneList find_zones(const Source& source);

/// Place of a zone in the list; 0: the first. Throws UsageError if there is none of that number.
std::size_t choose_zone(const ZoneList& list, int number, const std::string& file);

}  // namespace winslow::io::su2
