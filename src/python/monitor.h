#pragma once

#include <pybind11/pybind11.h>

#include "core/error.h"
#include "core/strategy/run.h"

namespace winslow::python {

/// Calls Python between the iterations of a run that has released the GIL: a progress callback, and
/// the handlers of signals, so that Ctrl-C ends the run.
///
///     PythonMonitor monitor(progress);
///     monitor.run([&] { result = winslow::execute(command, state, options); });
class PythonMonitor final : public SolverMonitor {
 public:
  /// progress: called with each IterationRecord; False cancels. None: nothing is called.
  explicit PythonMonitor(pybind11::object progress) : progress_(std::move(progress)) {}

  bool on_iteration(const IterationRecord& record, const Coordinates& x) override;
  bool cancelled() override;

  /// Runs work() without the GIL. Throws what it throws, and the exception of Python that cancelled
  /// it: that of the callback, KeyboardInterrupt.
  template <class Work>
  void run(const Work& work) {
    try {
      const pybind11::gil_scoped_release released;
      work();
    } catch (const Cancelled&) {
      if (!raised_) throw;
    }
    // Also where the run had ended before it saw that it was to end.
    if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
  }

 private:
  bool signals_are_due();
  /// Calls back with the GIL. False: Python raised something, or the callback returned False.
  template <class Call>
  bool call_python(const Call& call);

  pybind11::object progress_;
  std::exception_ptr raised_;
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
};

/// Adds Iteration, what a callback is called with.
void bind_iteration(pybind11::module_& module);

}  // namespace winslow::python
