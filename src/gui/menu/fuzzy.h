#pragma once

#include <optional>
#include <string_view>

namespace winslow::gui {

/// How well the letters of a query fit a text: all of them must be in it, in this order, in any
/// case; spaces of the query do not count. Letters at the beginning of words and letters side by
/// side weigh more, so that "sa" finds "Save as" before "Quality tab". None: it does not fit.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

}  // namespace winslow::gui
