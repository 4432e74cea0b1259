#pragma once

#include <pybind11/pybind11.h>

#include "core/sensitivity/mesh_sensitivity.h"
#include "python/mesh_value.h"

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
/// An object of that class for a derivative that is made already. mesh: any with the connectivity.
pybind11::object sensitivity_of(const MeshPointer& mesh, std::vector<std::string> markers,
                                std::shared_ptr<const MeshSensitivity> made);

/// Adds Deformer: a mesh whose boundary moves many times.
void bind_session(pybind11::module_& module);

/// Adds picture: a mesh as a PNG, without a display. Not in a build without graphics.
void bind_pictures(pybind11::module_& module);

}  // namespace winslow::python
