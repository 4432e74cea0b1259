#include "gui/menu/command_search.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "gui/menu/fuzzy.h"

namespace winslow::gui {

namespace {

/// How a word was found, the best last.
enum class Found { no, word_begins, word, label_begins, label };

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // Bytes of UTF-8 beyond ASCII belong to words.
    if (std::isalnum(byte) != 0 || byte >= 0x80)
      words.back() += static_cast<char>(std::tolower(byte));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::string_view singular(std::string_view word) {
  if (word.size() > 3 && word.ends_with('s')) word.remove_suffix(1);
  return word;
}

bool has(const std::vector<std::string>& words, std::string_view wanted) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return singular(word) == singular(wanted); });
}

bool has_beginning(const std::vector<std::string>& words, std::string_view wanted) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return word.starts_with(singular(wanted)); });
}

Found find(std::string_view wanted, const std::vector<std::string>& label,
           const std::vector<std::string>& words) {
  if (has(label, wanted)) return Found::label;
  if (has_beginning(label, wanted)) return Found::label_begins;
  if (has(words, wanted)) return Found::word;
  // Two letters begin something in every list of words.
  return wanted.size() > 2 && has_beginning(words, wanted) ? Found::word_begins : Found::no;
}

}  // namespace

std::optional<int> search_score(std::string_view query, std::string_view label,
                                std::string_view words) {
  const std::vector<std::string> in_label = words_of(label);
  const std::vector<std::string> in_words = words_of(words);
  Found worst = Found::label;
  for (const std::string& wanted : words_of(query))
    worst = std::min(worst, find(wanted, in_label, in_words));
  const std::optional<int> by_letters = fuzzy_score(query, label);
  if (worst == Found::no) return by_letters;
  return static_cast<int>(worst) * found_by_words + by_letters.value_or(0);
}

}  // namespace winslow::gui
