#pragma once

#include <filesystem>

#include "core/outer/outer_solver.h"

/// The iterations of one command as a table:
///
///     winslow::io::write_convergence_csv("history.csv", {{1, result.smooth.history}});
namespace winslow::io {

/// The outer iterations of one command.
struct ConvergenceTable {
  int command = 1;  ///< its number, 1 for the first
  std::span<const IterationRecord> records;
};

/// Writes one line for every outer iteration: iteration, residual, largest_move, inverted,
/// min_sine, damping, clipped, linear_iterations, fraction, command, stage. Numbers read back to
/// the same bits. Atomically. Throws OutputError.
void write_convergence_csv(const std::filesystem::path& path,
                           const std::vector<ConvergenceTable>& tables);

}  // namespace winslow::io
