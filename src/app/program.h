#pragma once

#include "app/output/exit_code.h"

namespace winslow::app {

/// The whole program: parses the command line, runs the subcommand, and turns every error into one
/// line on the standard error and an exit code. Throws nothing.
ExitCode run_program(int argc, char** argv);

}  // namespace winslow::app
