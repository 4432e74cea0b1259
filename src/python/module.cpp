#include <pybind11/pybind11.h>

#include "core/version.h"
#include "python/edit_run.h"
#include "python/errors.h"
#include "python/measures.h"
#include "python/mesh_value.h"
#include "python/monitor.h"

/// The extension winslow._winslow. Users meet the package around it: src/python/winslow.
PYBIND11_MODULE(_winslow, module) {
  module.doc() =
      "The compiled part of the package winslow. Its functions are for the package alone.";
  module.attr("version") = WINSLOW_VERSION;
  winslow::python::translate_errors();
  winslow::python::bind_iteration(module);
  winslow::python::bind_mesh(module);
  winslow::python::bind_commands(module);
  winslow::python::bind_measures(module);
  winslow::python::bind_sweep(module);
  winslow::python::bind_sensitivity(module);
  winslow::python::bind_session(module);
#ifdef WINSLOW_PYTHON_DRAWS
  winslow::python::bind_pictures(module);
  constexpr bool draws = true;
#else
  constexpr bool draws = false;
#endif
  module.attr("draws") = draws;
}
