#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/options/option.h"

namespace winslow::app {

/// Declares a flag for each option of a table that has one: what it takes is checked as it is
/// parsed. The object that the table is bound to must outlive the parsing.
void add_option_flags(CLI::App& app, const OptionTable& table, const std::string& group);

/// What the help says after a flag: "N [500]", "auto|on|off [auto]".
std::string flag_text(const Option& option);
/// What the help says of an option, and of what there is to choose from.
std::string flag_help(const Option& option);

}  // namespace winslow::app
