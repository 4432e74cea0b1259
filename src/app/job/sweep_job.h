#pragma once

#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "core/command/series.h"
#include "io/tables/motion_table.h"

namespace winslow::app {

/// A sweep: motions of one mesh, each written to a file of its own.
struct SweepJob {
  JobFiles files;  ///< `output` is a pattern: output_name()
  std::vector<io::MotionStep> steps;
  std::string table;  ///< file that the steps are from, which is not written over; empty: none
  MotionOptions how;
  SmoothOptions smooth;
  std::vector<std::string> held;  ///< markers whose layers keep their heights
  std::string results;            ///< CSV; empty: none
  int jobs = 1;                   ///< steps at once
};

/// The name of a step's file: the pattern, in which {step}, {rotate}, {translate_x}, {translate_y}
/// and {translate_z} stand for what the step is. Throws UsageError for another word in braces, and
/// for the motion of a body where several bodies move.
std::string output_name(const std::string& pattern, const io::MotionStep& step);

/// Runs a sweep. Files are checked before the solve: two steps never have one file, and nothing
/// that is read is written over. Each result is written as soon as there is one, whole or not at
/// all. Throws the library's errors.
ExitCode run_sweep_job(const SweepJob& job);

}  // namespace winslow::app
