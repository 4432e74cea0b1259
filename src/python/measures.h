#pragma once

#include <pybind11/pybind11.h>

namespace winslow::python {

/// Adds the functions that measure a mesh:
///
///     quality(mesh, worst, bins, threads) -> JSON, as the command line reports it
///     values(mesh, name, before) -> a number for each element
///     inverted(mesh), fields(mesh)
void bind_measures(pybind11::module_& module);

/// Adds sweep: many motions of one mesh.
void bind_sweep(pybind11::module_& module);

/// Adds Sensitivity: the derivative of a moved mesh by its boundary.
void bind_sensitivity(pybind11::module_& module);

/// Adds picture: a mesh as a PNG, without a display. A build without graphics raises Error.
void bind_pictures(pybind11::module_& module);

}  // namespace winslow::python
