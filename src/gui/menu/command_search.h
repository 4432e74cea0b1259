#pragma once

#include <optional>
#include <string_view>

namespace winslow::gui {

/// How well a command fits what was typed; none: it does not.
///
/// Commands that have every word of the query come first: those that have them in their label as
/// they are typed ("case e" finds "Case E"), then those with a word of the label that begins so
/// ("rot" finds "Rotate"), then those found by `words`, which say in other terms what the command
/// is about. What is left is found by its letters in their order (gui/menu/command_search.h), so
/// that "legnd" finds "Legend". A plural finds the singular. Empty queries fit everything alike.
///
/// From `found_by_words` on all words of the query were found; below, its letters.
inline constexpr int found_by_words = 1'000'000;
std::optional<int> search_score(std::string_view query, std::string_view label,
                                std::string_view words);

/// How well the letters of a query fit a text: all of them must be in it, in this order, in any
/// case; spaces of the query do not count. Letters at the beginning of words and letters side by
/// side weigh more, so that "sa" finds "Save as" before "Quality tab". None: it does not fit.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

}  // namespace winslow::gui
