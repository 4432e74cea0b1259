#include "app/output/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <iostream>

#include "app/options/flags.h"
#include "core/error.h"
#include "io/file/atomic_file.h"

namespace winslow::app {

std::string printable(std::string_view text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are C2 80 to C2 9F in UTF-8; terminals interpret some of them as well.
    const bool c1 = byte == 0xc2 && i + 1 < text.size() &&
                    (static_cast<unsigned char>(text[i + 1]) & 0xe0) == 0x80;
    if (c1) {
      safe += formatted("\\x%02x", static_cast<unsigned char>(text[++i]));
    } else if ((byte < 0x20 && byte != '\n') || byte == 0x7f) {
      safe += formatted("\\x%02x", byte);
    } else {
      safe += text[i];
    }
  }
  return safe;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings)
    std::cerr << "winslow: warning: " << printable(text) << '\n';
}

void print_remarks(const std::vector<std::string>& remarks) {
  for (const std::string& text : remarks) std::cout << printable(text) << '\n';
}

OutputForData::OutputForData(bool wanted) {
  if (wanted) before_ = std::cout.rdbuf(std::cerr.rdbuf());
}

OutputForData::~OutputForData() {
  if (before_) std::cout.rdbuf(before_);
}

void write_text(const std::string& path, std::string_view text) {
  if (path != standard_output)
    return io::write_atomically(path, [&](std::ostream& out) { out << text; });
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0)
    throw OutputError(std::string("the standard output cannot be written: ") +
                      std::strerror(errno));
}

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void note(int) { interrupted.store(true); }

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted.store(false);
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool InterruptGuard::requested() { return interrupted.load(); }

void InterruptGuard::check() {
  if (requested()) throw Cancelled();
}

SignalsHeld::SignalsHeld() {
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &held, &old_mask_);
}

SignalsHeld::~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr); }

namespace {

constexpr double seconds_between_lines = 0.1;
constexpr const char* clear_line = "\r\x1b[K";

/// Columns of the terminal; a longer line would wrap and could not be erased.
std::size_t columns() {
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

bool ProgressMonitor::cancelled() { return InterruptGuard::requested(); }

bool ProgressMonitor::on_iteration(const IterationRecord& record, const Coordinates&) {
  if (visible_ && (!drawn_ || since_drawn_.seconds() > seconds_between_lines)) {
    std::string line =
        label_ + formatted(": iteration %d, residual %.1e, %d inverted, smallest sine %.3f",
                           record.iteration, record.residual, static_cast<int>(record.inverted),
                           record.min_sine);
    if (record.fraction < 1) line += formatted(", %.0f %% of the motion", 100 * record.fraction);
    line.resize(std::min(line.size(), columns() - 1));
    std::fprintf(stderr, "%s%s", clear_line, line.c_str());
    std::fflush(stderr);
    drawn_ = true;
    since_drawn_.lap();
  }
  return !cancelled();
}

void ProgressMonitor::clear() {
  if (drawn_) {
    std::fputs(clear_line, stderr);
    std::fflush(stderr);
  }
  drawn_ = false;
}

bool terminal_attached() { return isatty(STDERR_FILENO) != 0; }

}  // namespace winslow::app
