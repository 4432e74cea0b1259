#include "gui/menu/command_search.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

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

namespace {

constexpr int letter = 2;
constexpr int begins_text = 12;
constexpr int begins_word = 8;
constexpr int adjoins = 6;
constexpr int none = std::numeric_limits<int>::min() / 2;

bool word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::optional<int> fuzzy_score(std::string_view query, std::string_view text) {
  std::string wanted;
  for (char c : query)
    if (c != ' ') wanted += lower(c);
  if (wanted.empty()) return 0;
  const std::size_t n = text.size();
  // best[j]: of the letters so far, the last of them matched at j.
  std::vector<int> best(n, none);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    std::vector<int> next(n, none);
    int before = i == 0 ? 0 : none;  // best that ends before j - 1
    for (std::size_t j = 0; j < n; ++j) {
      const int beside = j > 0 && i > 0 ? best[j - 1] : none;
      if (lower(text[j]) == wanted[i]) {
        int own = letter;
        if (j == 0)
          own += begins_text;
        else if (!word_character(text[j - 1]))
          own += begins_word;
        const int from = std::max(before, beside == none ? none : beside + adjoins);
        if (from != none) next[j] = from + own;
      }
      before = std::max(before, beside);
    }
    best = std::move(next);
  }
  const int score = n == 0 ? none : *std::max_element(best.begin(), best.end());
  if (score == none) return std::nullopt;
  // Of two that fit alike, the shorter: more of it is what was typed.
  return 64 * score - static_cast<int>(std::min<std::size_t>(n, 63));
}

}  // namespace winslow::gui
