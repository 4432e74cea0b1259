#include "io/openfoam/foam_scanner.h"

#include <algorithm>

#include "io/text/numbers.h"

namespace winslow::io::openfoam {
namespace {

constexpr std::string_view punctuation = "(){};[]";

}  // namespace

void FoamScanner::skip() {
  const auto text = source_.text().substr(0, range_.end);
  for (;;) {
    scan_.skip_space();
    const auto rest = text.substr(std::min(scan_.offset(), text.size()));
    if (rest.starts_with("//")) {
      scan_.line();
    } else if (rest.starts_with("/*")) {
      const auto end = text.find("*/", scan_.offset() + 2);
      if (end == std::string_view::npos)
        source_.fail(scan_.offset(), "a comment without end", "*/");
      scan_.seek(end + 2);
    } else {
      return;
    }
  }
}

std::size_t FoamScanner::offset() {
  skip();
  return scan_.offset();
}

std::string_view FoamScanner::next() {
  skip();
  const auto text = source_.text().substr(0, range_.end);
  const std::size_t begin = std::min(scan_.offset(), text.size());
  std::size_t end = begin;
  if (begin < text.size() && text[begin] == '"') {
    end = std::min(text.find('"', begin + 1), text.size() - 1) + 1;
  } else if (begin < text.size() && punctuation.find(text[begin]) != std::string_view::npos) {
    end = begin + 1;
  } else {
    end = std::min(text.find_first_of("(){};[] \t\r\n\v\f", begin), text.size());
  }
  scan_.seek(end);
  return text.substr(begin, end - begin);
}

std::string_view FoamScanner::peek() {
  const std::size_t here = offset();
  const auto word = next();
  scan_.seek(here);
  return word;
}

void FoamScanner::expect(std::string_view word) {
  const auto found = next();
  if (found != word) fail(found, "'" + std::string(word) + "'");
}

std::int64_t FoamScanner::integer(const Expected& expected) {
  const auto word = next();
  const auto value = parse_integer(word);
  if (!value) fail(word, expected.text());
  return *value;
}

double FoamScanner::number(const Expected& expected) {
  const auto word = next();
  const auto value = parse_number(word);
  if (!value) fail(word, expected.text());
  return *value;
}

Index FoamScanner::count(const Expected& expected, std::size_t bytes_each) {
  const std::size_t at = offset();
  return checked_count(source_, at, integer(expected), bytes_each, bytes_left(), expected);
}

void read_foam_header(FoamScanner& scan) {
  if (scan.peek() != "FoamFile") return;
  scan.next();
  scan.expect("{");
  for (auto key = scan.next(); key != "}"; key = scan.next()) {
    if (key.empty()) scan.fail(key, "'}'");
    const auto value = scan.peek();
    if (key == "format" && value != "ascii")
      scan.fail(value, "ascii (foamFormatConvert writes it)");
    if (key == "class" && value == "faceCompactList") scan.fail(value, "faceList");
    for (auto word = scan.next(); word != ";"; word = scan.next()) {
      if (word.empty()) scan.fail(word, "';'");
    }
  }
}

}  // namespace winslow::io::openfoam
