#include "gui/menu/fuzzy.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

namespace winslow::gui {

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
