#include "io/su2/su2_lines.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "io/text/numbers.h"

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

namespace {

struct Keyword {
  std::size_t line_begin;
  std::string_view value;
};

/// Lines that begin with this keyword. Looks for the keyword instead of reading every line: meshes
/// are large, and most have one zone.
std::vector<Keyword> lines_of(const Source& source, std::string_view key) {
  std::vector<Keyword> found;
  const auto text = source.text();
  for (auto start = text.find(key); start != std::string_view::npos;
       start = text.find(key, start + 1)) {
    const auto newline = text.rfind('\n', start);
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const Line line = LineReader(source, begin, text.size()).next();
    const bool seen = !found.empty() && found.back().line_begin == begin;  // again in a comment
    if (line.key == key && !seen) found.push_back({begin, line.value});
  }
  return found;
}

int positive(const Source& source, const Keyword& line, const char* key) {
  const auto value = parse_integer(line.value);
  if (!value || *value < 1 || *value > std::numeric_limits<int>::max()) {
    source.fail(line.line_begin, std::string(key) + "= " + in_quotes(line.value),
                "a number from 1");
  }
  return static_cast<int>(*value);
}

}  // namespace

std::vector<int> ZoneList::numbers() const {
  std::vector<int> all;
  for (const Zone& zone : zones) all.push_back(zone.number);
  return all;
}

std::vector<std::string> ZoneList::blocks(const Source& source) const {
  std::vector<std::string> all{std::string(source.text().substr(0, zones.front().begin))};
  for (const Zone& zone : zones) {
    all.emplace_back(source.text().substr(zone.begin, zone.end - zone.begin));
  }
  return all;
}

ZoneList find_zones(const Source& source) {
  const auto counts = lines_of(source, "NZONE");
  const auto starts = lines_of(source, "IZONE");
  const std::size_t end = source.text().size();
  const int declared =
      counts.empty() ? static_cast<int>(starts.size()) : positive(source, counts[0], "NZONE");
  if (counts.size() > 1) source.fail(counts[1].line_begin, "a second NZONE=", "one only");
  ZoneList list;
  if (declared <= 1 && starts.size() <= 1) {
    list.zones.push_back({starts.empty() ? 1 : positive(source, starts[0], "IZONE"), 0, end});
    return list;
  }
  list.several = true;
  if (starts.size() != static_cast<std::size_t>(declared)) {
    source.fail(counts[0].line_begin, std::to_string(starts.size()) + " IZONE= in the file",
                std::to_string(declared) + " as NZONE= says");
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const int number = positive(source, starts[i], "IZONE");
    for (const auto& zone : list.zones) {
      if (zone.number == number) {
        source.fail(starts[i].line_begin, "a second zone " + std::to_string(number), "one only");
      }
    }
    list.zones.push_back(
        {number, starts[i].line_begin, i + 1 < starts.size() ? starts[i + 1].line_begin : end});
  }
  return list;
}

std::size_t choose_zone(const ZoneList& list, int number, const std::string& file) {
  if (number == 0) return 0;
  for (std::size_t i = 0; i < list.zones.size(); ++i) {
    if (list.zones[i].number == number) return i;
  }
  throw UsageError(file + ": no zone " + std::to_string(number) + " in the file, expected one of " +
                   listed(list.numbers()));
}

std::string listed(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

}  // namespace winslow::io::su2
