#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace winslow::app {

/// The tables of the reference pages (docs), as Markdown: what tables of options, metrics and
/// formats say. docs/make_reference.py puts them into the pages, and a test compares them.
std::vector<std::string> reference_names();
/// Throws UsageError for a name that is not among them.
void print_reference(std::ostream& out, const std::string& name);

}  // namespace winslow::app
