#include "io/text/scanner.h"

#include <limits>

#include "io/text/numbers.h"

namespace winslow::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::string Expected::text() const {
  std::string s = what;
  if (index >= 0) s += " " + std::to_string(index + 1);
  if (count >= 0) s += " of " + std::to_string(count);
  return s;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (is_blank(text.front()) || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\n')) text.remove_suffix(1);
  return text;
}

std::string_view Scanner::line() {
  const std::size_t begin = position_;
  std::size_t end = text_.find('\n', begin);
  position_ = end == std::string_view::npos ? text_.size() : end + 1;
  if (end == std::string_view::npos) end = text_.size();
  if (end > begin && text_[end - 1] == '\r') --end;
  return text_.substr(begin, end - begin);
}

void Scanner::skip_space() {
  while (position_ < text_.size() && (is_blank(text_[position_]) || text_[position_] == '\n')) {
    ++position_;
  }
}

std::string_view Scanner::word() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '\n') {
    ++position_;
  }
  return text_.substr(begin, position_ - begin);
}

std::int64_t Scanner::integer(const Expected& expected) {
  const auto found = word();
  const auto value = parse_integer(found);
  if (!value) fail(found, expected);
  return *value;
}

double Scanner::number(const Expected& expected) {
  const auto found = word();
  const auto value = parse_number(found);
  if (!value) fail(found, expected);
  return *value;
}

Index Scanner::index(const Expected& expected) {
  const auto found = word();
  const auto value = parse_integer(found);
  if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) fail(found, expected);
  return static_cast<Index>(*value);
}

Index Scanner::count(const Expected& expected, std::size_t bytes_each) {
  const auto found = word();
  const auto value = parse_integer(found);
  if (!value) fail(found, expected);
  return checked_count(source_, source_.offset_of(found), *value, bytes_each, bytes_left(),
                       expected);
}

void Scanner::end_line(const Expected& expected) {
  const auto extra = word();
  if (!extra.empty()) fail(extra, expected);
  if (!at_end()) ++position_;
}

void Scanner::fail(std::string_view found, const Expected& expected) const {
  fail(found, expected.text());
}

void Scanner::fail(std::string_view found, const std::string& expected) const {
  const std::size_t offset = source_.offset_of(found);
  if (!found.empty()) source_.fail(offset, in_quotes(found), expected);
  const char* end = offset >= source_.text().size() ? "the end of the file"
                    : offset >= text_.size()        ? "the end of the data"
                                                    : "the end of the line";
  source_.fail(offset, end, expected);
}

Index checked_count(const Source& source, std::size_t offset, std::int64_t count,
                    std::size_t bytes_each, std::size_t bytes_left, const Expected& expected) {
  if (count < 0) source.fail(offset, std::to_string(count), expected.text());
  // The last entry may lack its line end.
  const auto most = static_cast<std::int64_t>(bytes_left / bytes_each + 1);
  if (count > most) {
    source.fail(offset, std::to_string(count) + " as " + expected.text(),
                "no more than the " + std::to_string(most) +
                    " that the rest of the file can hold (a wrong count, or a truncated file)");
  }
  if (count > std::numeric_limits<Index>::max()) {
    source.fail(offset, std::to_string(count) + " as " + expected.text(), "at most 2147483647");
  }
  return static_cast<Index>(count);
}

}  // namespace winslow::io
