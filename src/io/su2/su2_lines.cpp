#include "io/su2/su2_lines.h"

#include <algorithm>

namespace winslow::io::su2 {

std::string_view LineWords::next() {
  const auto blank = [](char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
  };
  const auto* begin = std::find_if_not(rest_.data(), rest_.data() + rest_.size(), blank);
  const auto* end = std::find_if(begin, rest_.data() + rest_.size(), blank);
  const std::string_view word(begin, static_cast<std::size_t>(end - begin));
  rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
  return word;
}

Line LineReader::next() {
  Line line;
  line.offset = scan_.offset();
  const auto whole = scan_.line();
  line.bytes = source_.text().substr(line.offset, scan_.offset() - line.offset);
  line.text = trimmed(whole.substr(0, whole.find('%')));
  const auto equals = line.text.find('=');
  if (equals == std::string_view::npos) return line;
  line.key = trimmed(line.text.substr(0, equals));
  line.value = trimmed(line.text.substr(equals + 1));
  return line;
}

Line LineReader::next_data(const Expected& expected) {
  while (!at_end()) {
    const Line line = next();
    if (!line.blank()) return line;
  }
  scan_.fail(source_.text().substr(end_, 0), expected);
}

}  // namespace winslow::io::su2
