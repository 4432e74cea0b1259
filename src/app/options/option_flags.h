#pragma once

#include <CLI/CLI.hpp>

#include "core/command/command.h"
#include "core/options/option.h"

namespace winslow::app {

/// Declares a flag for each option of a table that has one: what it takes is checked as it is
/// parsed. The object that the table is bound to must outlive the parsing.
void add_option_flags(CLI::App& app, const OptionTable& table, const std::string& group);

/// What the help says after a flag: "N [500]", "auto|on|off [auto]".
std::string flag_text(const Option& option);
/// What the help says of an option, and of what there is to choose from.
std::string flag_help(const Option& option);

/// Declares a flag for each option of smoothing. `options` must outlive the parsing.
void add_smooth_flags(CLI::App& app, SmoothOptions& options);

/// Declares --min-quality, which may be given several times.
void add_min_quality_flag(CLI::App& app, QualityFloor& floor);

/// Declares --direct.
void add_direct_flag(CLI::App& app, MotionOptions& options);

/// Declares --marker, which may be given several times.
void add_marker_flag(CLI::App& app, std::vector<std::string>& markers);

}  // namespace winslow::app
