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

}  // namespace winslow::app
