#pragma once

#include <filesystem>
#include <vector>

#include "app/output/report.h"

namespace winslow::app {

/// Writes one line for every outer iteration of every command: iteration, residual, largest_move,
/// inverted, min_sine, damping, clipped, linear_iterations, fraction, command (1 for the first).
/// Throws OutputError.
void write_history(const std::filesystem::path& path, const std::vector<CommandRecord>& commands);

}  // namespace winslow::app
