#include "app/job/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

#include "core/error.h"

namespace winslow::app {
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

/// Columns of the terminal: a longer line would wrap and stay behind.
std::size_t columns() {
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

bool ProgressMonitor::cancelled() { return InterruptGuard::requested(); }

bool ProgressMonitor::on_iteration(const IterationRecord& record, const Coordinates&) {
  if (visible_ && (!drawn_ || since_drawn_.seconds() > seconds_between_lines)) {
    std::array<char, 160> numbers;
    std::snprintf(numbers.data(), numbers.size(),
                  ": iteration %d, residual %.1e, %d inverted, smallest sine %.3f",
                  record.iteration, record.residual, static_cast<int>(record.inverted),
                  record.min_sine);
    std::string line = label_ + numbers.data();
    if (record.fraction < 1) {
      std::snprintf(numbers.data(), numbers.size(), ", %.0f %% of the motion",
                    100 * record.fraction);
      line += numbers.data();
    }
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
