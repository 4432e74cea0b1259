#pragma once

#include <filesystem>

#include "core/mesh/coordinates.h"
#include "core/outer/outer_solver.h"

namespace winslow::gui {

/// What a command led to, exactly: it reads back to the same bits. Files are for the machine that
/// wrote them.
struct StepData {
  Coordinates coordinates;
  SmoothResult smooth;
};

/// Atomically. Throws OutputError.
void write_step(const std::filesystem::path& path, const Coordinates& coordinates,
                const SmoothResult& smooth);
/// Throws InputError for a file that is missing, cut short or changed.
StepData read_step(const std::filesystem::path& path);

}  // namespace winslow::gui
