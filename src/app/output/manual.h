#pragma once

#include <ostream>

#include "app/output/program_options.h"

namespace winslow::app {

/// The manual page winslow.1, in roff with the macros of man(7). Groups of options that several
/// commands have alike are described once.
void print_manual(std::ostream& out, const ProgramOptions& program);

}  // namespace winslow::app
