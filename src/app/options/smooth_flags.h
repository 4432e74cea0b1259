#pragma once

#include <CLI/CLI.hpp>

#include "core/command/command.h"

namespace winslow::app {

/// Declares a flag for each option of smoothing. `options` must outlive the parsing.
void add_smooth_flags(CLI::App& app, SmoothOptions& options);

/// Declares --min-quality, which may be given several times.
void add_min_quality_flag(CLI::App& app, QualityFloor& floor);

/// Declares --direct.
void add_direct_flag(CLI::App& app, MotionOptions& options);

/// Declares --marker, which may be given several times.
void add_marker_flag(CLI::App& app, std::vector<std::string>& markers);

}  // namespace winslow::app
