#include "app/options/suggestion.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace winslow::app {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

constexpr const char* words_name = "words";  // of the validators that hold names
constexpr std::string_view separator = ", ";

/// Levenshtein distance, blind to case.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string join(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += std::string(list.empty() ? "" : separator) + name;
  return list;
}

std::string suggest(std::string_view unknown, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  // Half of a word may be wrong before a suggestion does more harm than good.
  std::size_t best = unknown.size() / 2 + 1;
  for (const std::string& name : known) {
    const std::size_t d = distance(unknown, name);
    if (d < best) {
      best = d;
      nearest = &name;
    }
  }
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

CLI::Validator one_of(std::vector<std::string> names) {
  const std::string list = join(names);
  return CLI::Validator(
      [names = std::move(names), list](std::string& value) {
        if (std::find(names.begin(), names.end(), value) != names.end()) return std::string();
        return "found \"" + value + "\", expected one of " + list + suggest(value, names);
      },
      "{" + list + "}", words_name);
}

CLI::Validator words_to_offer(const std::vector<std::string>& words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "{" + join(words) + "}",
                        words_name);
}

std::vector<std::string> words_of(CLI::Option& option) {
  std::string list;
  try {
    list = option.get_validator(words_name)->get_description();
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
  std::vector<std::string> words;
  list = list.substr(1, list.size() - 2).append(separator);  // without its braces
  for (std::size_t at = 0, end = 0; (end = list.find(separator, at)) != std::string::npos;
       at = end + separator.size())
    words.push_back(list.substr(at, end - at));
  return words;
}

}  // namespace winslow::app
