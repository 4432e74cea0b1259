#pragma once

#include "app/options/file_flags.h"
#include "app/output/terminal.h"
#include "core/command/command.h"

namespace winslow::app {

/// A run that reads a mesh, applies commands to it, and writes what comes out.
struct EditJob {
  std::string name;  ///< the subcommand
  JobFiles files;
  std::vector<Command> commands;
};

/// Runs a job. Files are checked before the solve; results are written after it, all or none:
/// the mesh only if it is valid or files.allow_inverted is set, report and history in any case.
/// Throws the library's errors; nothing is written then.
ExitCode run_edit_job(const EditJob& job);

}  // namespace winslow::app
