#pragma once

#include <csignal>

#include "app/output/report.h"
#include "core/strategy/run.h"

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

/// Watches a solve for the command line: keeps a line on the terminal up to date, and cancels the
/// solve after Ctrl-C.
class ProgressMonitor : public SolverMonitor {
 public:
  /// visible: draw the line. Only sensible on a terminal.
  explicit ProgressMonitor(bool visible) : visible_(visible) {}
  ~ProgressMonitor() override { clear(); }

  bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) override;
  bool cancelled() override;
  /// What the line begins with, e.g. "Rotate flap by -40 deg".
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
