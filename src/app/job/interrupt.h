#pragma once

#include <csignal>

namespace winslow::app {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the program, so that a job can
/// stop between two iterations. The second signal ends the program the usual way.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();
  /// Throws Cancelled if a signal has come.
  static void check();

 private:
  struct sigaction old_interrupt_ = {}, old_terminate_ = {};
};

/// Holds signals back while results are written: all of them are written, or none.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t old_mask_ = {};
};

}  // namespace winslow::app
