#include "io/su2/su2_lines.h"

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

std::vector<Line> lines_with(const Source& source, std::size_t begin, std::size_t end,
                             std::string_view key, std::size_t most) {
  std::vector<Line> found;
  const auto text = source.text().substr(0, end);
  for (auto start = text.find(key, begin); start != std::string_view::npos && found.size() < most;
       start = text.find(key, start + 1)) {
    const Line line = LineReader(source, line_begin(text, start), end).next();
    const bool seen = !found.empty() && found.back().offset == line.offset;  // again in a comment
    if (line.key == key && !seen) found.push_back(line);
  }
  return found;
}

namespace {

std::vector<Line> lines_of(const Source& source, std::string_view key) {
  return lines_with(source, 0, source.text().size(), key);
}

int positive(const Source& source, const Line& line, const char* key) {
  const auto value = parse_integer(line.value);
  if (!value || *value < 1 || *value > std::numeric_limits<int>::max()) {
    source.fail(line.offset, std::string(key) + "= " + in_quotes(line.value), "a number from 1");
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
  if (counts.size() > 1) source.fail(counts[1].offset, "a second NZONE=", "one only");
  ZoneList list;
  if (declared <= 1 && starts.size() <= 1) {
    list.zones.push_back({starts.empty() ? 1 : positive(source, starts[0], "IZONE"), 0, end});
    return list;
  }
  list.several = true;
  if (starts.size() != static_cast<std::size_t>(declared)) {
    source.fail(counts[0].offset, std::to_string(starts.size()) + " IZONE= in the file",
                std::to_string(declared) + " as NZONE= says");
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const int number = positive(source, starts[i], "IZONE");
    for (const auto& zone : list.zones) {
      if (zone.number == number) {
        source.fail(starts[i].offset, "a second zone " + std::to_string(number), "one only");
      }
    }
    list.zones.push_back(
        {number, starts[i].offset, i + 1 < starts.size() ? starts[i + 1].offset : end});
  }
  return list;
}

std::size_t choose_zone(const ZoneList& list, int number, const std::string& file) {
  if (number == 0) return 0;
  for (std::size_t i = 0; i < list.zones.size(); ++i) {
    if (list.zones[i].number == number) return i;
  }
  throw UsageError(
      file + ": no zone " + std::to_string(number) + " in the file, expected one of " +
      list_of(list.zones, [](const auto& zone) { return std::to_string(zone.number); }));
}

}  // namespace winslow::io::su2
