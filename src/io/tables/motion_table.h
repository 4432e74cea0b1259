#pragma once

#include <filesystem>

#include "core/motion/motion.h"

/// Reads the steps of a series from a table:
///
///     winslow::Series series;
///     for (const winslow::io::MotionStep& step : winslow::io::read_motions("motions.csv"))
///       series.steps.push_back(step.bodies);
namespace winslow::io {

/// The bodies that move together in one step.
struct MotionStep {
  std::string name;  ///< what the column `step` says; without it the number of the row, from 1
  std::vector<MovingBody> bodies;
  int line = 0;  ///< of the file, of the first of its rows
};

/// Reads a CSV file of motions (separators: comma, semicolon, tab or blanks; '#' starts a comment).
/// The first line names the columns, in any order: step, marker, rotate, pivot_x, pivot_y, pivot_z,
/// axis_x, axis_y, axis_z, translate_x, translate_y, translate_z. Each row is the motion of a body.
/// Rows with the same step move together; without that column each row is a step. A body of several
/// markers has their names with commas between them, in quotes: "flap,tab". Columns that are
/// missing and fields that are empty are those of `otherwise`, and 0 for translations and rotations
/// that it does not give either. The columns with z are for volume meshes.
///
/// Throws InputError "FILE:LINE: found ..., expected ...", also for a row without a marker, a step
/// that moves a marker twice, and a vector of which a component is missing.
std::vector<MotionStep> read_motions(const std::filesystem::path& path,
                                     const MovingBody& otherwise = {});

}  // namespace winslow::io
