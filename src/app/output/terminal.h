#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::app {

/// What the program's exit status means. Scripts rely on these numbers.
enum class ExitCode {
  done = 0,           ///< done, and the mesh is valid
  internal = 1,       ///< a fault of the program or the machine (out of memory, no OpenGL)
  usage = 2,          ///< options or arguments that make no sense
  input = 3,          ///< a file that cannot be read, is wrong, or cannot be written
  inverted = 4,       ///< the result has inverted elements, or the motion was not completed
  not_converged = 5,  ///< not converged: the limit of iterations, or no gain any more
  interrupted = 130,  ///< stopped by Ctrl-C or SIGTERM
};

/// The same for the foot of help texts.
inline constexpr std::string_view exit_code_help =
    "Exit status: 0 done and valid; 2 wrong usage; 3 a file cannot be read, is wrong or cannot be\n"
    "written; 4 the result has inverted elements (nothing is written unless --allow-inverted), or\n"
    "the motion could not be completed (nothing is written unless --accept-partial); 5 not "
    "converged\n"
    "within the limit, or nothing gained any more (written if valid); 130 interrupted (nothing\n"
    "written).";

/// What printf() would print, cut off after 199 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// Text that is safe to print: names in files and of files may hold escape sequences, with which a
/// terminal can be made to do things. Control characters become \\xNN (also those of the C1 set, in
/// UTF-8); line ends stay.
std::string printable(std::string_view text);

/// Prints each to the standard error, as a line "winslow: warning: ...".
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace winslow::app
