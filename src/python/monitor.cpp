#include "python/monitor.h"

namespace py = pybind11;

namespace winslow::python {

template <class Call>
bool PythonMonitor::call_python(const Call& call) {
  const py::gil_scoped_acquire acquired;
  if (raised_) return false;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return call();
  } catch (const py::error_already_set&) {
    raised_ = std::current_exception();
    return false;
  }
}

bool PythonMonitor::signals_are_due() {
  constexpr auto interval = std::chrono::milliseconds(20);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < interval) return false;
  last_look_ = now;
  return true;
}

bool PythonMonitor::on_iteration(const IterationRecord& record, const Coordinates&) {
  if (progress_.is_none()) return !cancelled();
  return call_python([&] {
    const py::object answer = progress_(record);
    return !answer.is(py::bool_(false));
  });
}

bool PythonMonitor::cancelled() {
  return signals_are_due() && !call_python([] { return true; });
}

void bind_iteration(py::module_& module) {
  py::class_<IterationRecord> record(module, "Iteration",
                                     "One row of a convergence history. Iteration 0 is the mesh as "
                                     "given.");
  record.def_readonly("iteration", &IterationRecord::iteration, "Number, from 0 on.");
  record.def_readonly("residual", &IterationRecord::residual,
                      "Largest scaled residual after the iteration.");
  record.def_readonly("largest_move", &IterationRecord::largest_move,
                      "Of any node, in units of the mesh.");
  record.def_readonly("inverted", &IterationRecord::inverted, "Number of inverted elements.");
  record.def_readonly("min_sine", &IterationRecord::min_sine, "Smallest normalized Jacobian.");
  record.def_readonly("damping", &IterationRecord::damping, "Damping as used.");
  record.def_readonly("clipped", &IterationRecord::clipped, "Negative weights were set to zero.");
  record.def_readonly("linear_iterations", &IterationRecord::linear_iterations,
                      "Iterations of the linear solver.");
  record.def_readonly("fraction", &IterationRecord::fraction,
                      "Share of the boundary motion applied so far.");
  record.def_property_readonly(
      "stage", [](const IterationRecord& of) { return std::string(stage_name(of.stage)); },
      "\"picard\", \"untangle\", \"relax\", \"descent\", \"path\", \"newton\" or \"worst\".");
  record.def("__repr__", [](const IterationRecord& of) {
    return py::str("<winslow.Iteration {}: {}, residual {:.3g}, {} inverted, fraction {:.6g}>")
        .format(of.iteration, std::string(stage_name(of.stage)), of.residual, of.inverted,
                of.fraction)
        .cast<std::string>();
  });
}

}  // namespace winslow::python
