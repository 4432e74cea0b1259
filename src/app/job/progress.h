#pragma once

#include <string>

#include "app/output/stopwatch.h"
#include "core/strategy/run.h"

namespace winslow::app {

/// Watches a solve for the command line: keeps a line on the terminal up to date, and cancels the
/// solve after Ctrl-C.
class ProgressMonitor : public SolverMonitor {
 public:
  /// visible: draw the line. Only sensible on a terminal.
  explicit ProgressMonitor(bool visible) : visible_(visible) {}
  ~ProgressMonitor() override { clear(); }

  bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) override;
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
