#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace winslow::app {

/// Text that is safe to print: names in files and of files may hold escape sequences, with which a
/// terminal can be made to do things. Control characters become \\xNN (also those of the C1 set, in
/// UTF-8); line ends stay.
std::string printable(std::string_view text);

/// Prints each to the standard error, as a line "winslow: warning: ...".
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace winslow::app
