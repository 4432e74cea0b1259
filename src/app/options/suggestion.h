#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::app {

/// "; did you mean X?" for the name in `known` that is nearest to `unknown`, "" if none is near.
std::string suggest(std::string_view unknown, const std::vector<std::string>& known);

/// "a, b, c".
std::string join(const std::vector<std::string>& names);

/// Accepts one of some names; the message for any other lists them and suggests the nearest.
CLI::Validator one_of(std::vector<std::string> names);
/// Accepts everything; shells offer these words (words_of()).
CLI::Validator words_to_offer(const std::vector<std::string>& words);
/// The names that an option takes, of its one_of() or words_to_offer(); empty: it has neither.
std::vector<std::string> words_of(CLI::Option& option);

}  // namespace winslow::app
