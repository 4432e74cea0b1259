#pragma once

#include <csignal>
#include <cstdio>

#include "app/output/report.h"
#include "core/strategy/run.h"

namespace winslow::app {

/// What the program's exit status means. Scripts rely on these numbers.
enum class ExitCode {
  done = 0,           ///< done, and the mesh is valid
  internal = 1,       ///< failure of the program or the machine (out of memory, no OpenGL)
  usage = 2,          ///< invalid options or arguments
  input = 3,          ///< a file that cannot be read, is wrong, or cannot be written
  inverted = 4,       ///< the result has inverted elements, or the motion was not completed
  not_converged = 5,  ///< not converged: the limit of iterations, or no gain any more
  tangled_rest = 6,   ///< the mesh whose shapes the targets keep has inverted elements
  held = 7,           ///< a body moved, and no other node of the mesh followed
  interrupted = 130,  ///< stopped by Ctrl-C or SIGTERM
};

/// The exit codes, for the end of help texts.
inline constexpr std::string_view exit_code_help =
    "Exit status: 0 done and valid; 2 wrong usage; 3 a file cannot be read, is wrong or cannot be\n"
    "written; 4 the result has inverted elements (nothing is written unless --allow-inverted), or\n"
    "the motion could not be completed (nothing is written unless --accept-partial); 5 not "
    "converged\n"
    "within the limit, or nothing gained any more (written if valid); 6 the mesh whose shapes the\n"
    "targets keep is tangled (nothing written); 7 a body moved, and no other node of the mesh\n"
    "followed (written if valid); 130 interrupted (nothing written).";

/// Formats like printf(), truncated to 199 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// Makes text safe to print: names in files and of files may hold escape sequences that control the
/// terminal. Control characters become \\xNN (also those of the C1 set, in UTF-8); line ends are
/// kept.
std::string printable(std::string_view text);

/// Prints each warning to the standard error, as a line "winslow: warning: ...".
void print_warnings(const std::vector<std::string>& warnings);
/// Prints sentences on what a run does, a line each, to the standard output.
void print_remarks(const std::vector<std::string>& remarks);

/// Keeps the standard output for data that other programs read: during its lifetime, what is
/// printed to std::cout goes to the standard error.
class OutputForData {
 public:
  /// wanted: false to change nothing.
  explicit OutputForData(bool wanted);
  ~OutputForData();
  OutputForData(const OutputForData&) = delete;
  OutputForData& operator=(const OutputForData&) = delete;

 private:
  std::streambuf* before_ = nullptr;
};

/// Writes text to the standard output itself if the path is standard_output, otherwise to a file,
/// atomically. Throws OutputError.
void write_text(const std::string& path, std::string_view text);

/// During its lifetime, SIGINT and SIGTERM are recorded instead of ending the program, so that a
/// job can stop between two iterations. A second signal ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();
  /// Throws Cancelled if a signal has arrived.
  static void check();

 private:
  struct sigaction old_interrupt_ = {}, old_terminate_ = {};
};

/// Blocks signals while results are written, so that all of them are written, or none.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t old_mask_ = {};
};

/// Monitors a solve for the command line: updates a progress line on the terminal and cancels the
/// solve after Ctrl-C.
class ProgressMonitor : public SolverMonitor {
 public:
  /// visible: draw the progress line (only useful on a terminal).
  explicit ProgressMonitor(bool visible) : visible_(visible) {}
  ~ProgressMonitor() override { clear(); }

  bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) override;
  bool cancelled() override;
  /// Sets the beginning of the line, e.g. "Rotate flap by -40 deg".
  void set_label(std::string label) { label_ = std::move(label); }
  /// Removes the line.
  void clear();

 private:
  bool visible_;
  bool drawn_ = false;
  std::string label_;
  Stopwatch since_drawn_;
};

/// True if the standard error is a terminal.
bool terminal_attached();

}  // namespace winslow::app
