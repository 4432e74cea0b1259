#pragma once

#include <ostream>

#include "app/output/program_options.h"

namespace winslow::app {

/// The manual page winslow.1, in roff with the macros of man(7). Groups of options that several
/// commands have alike are described once.
void print_manual(std::ostream& out, const ProgramOptions& program);

/// The tables of the reference pages (docs), as Markdown: what tables of options, metrics and
/// formats say. docs/make_reference.py puts them into the pages, and a test compares them.
std::vector<std::string> reference_names();
/// Throws UsageError for a name that is not among them.
void print_reference(std::ostream& out, const std::string& name);

}  // namespace winslow::app
