#pragma once

#include <CLI/CLI.hpp>

#include "core/command/command.h"

namespace winslow::app {

/// Declares --formulation, --linear, --damping, --fixed-damping, --acceleration, --clip,
/// --max-iterations, --tolerance, --threads.
/// `options` must outlive the parsing.
void add_smooth_flags(CLI::App& app, SmoothOptions& options);

/// Declares --increments and --no-smooth.
void add_motion_flags(CLI::App& app, MotionOptions& options);

/// Declares --marker, which may be given several times.
void add_marker_flag(CLI::App& app, std::vector<std::string>& markers);

/// Declares an option that takes the two components of a vector. Returns it.
CLI::Option* add_vector_flag(CLI::App& app, const std::string& name, Vec2& value,
                             const std::string& description);

}  // namespace winslow::app
