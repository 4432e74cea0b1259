#pragma once

#include <ostream>

#include "app/output/program_options.h"

namespace winslow::app {

/// Shells that completions can be written for: "bash", "fish", "zsh".
std::vector<std::string> completion_shells();
/// A script that completes commands, options, what options take, and the names of markers of text
/// SU2 and MSH files on the command line. Throws UsageError for another shell.
void print_completion(std::ostream& out, const ProgramOptions& program, const std::string& shell);

}  // namespace winslow::app
