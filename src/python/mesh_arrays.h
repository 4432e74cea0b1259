#pragma once

#include "python/mesh_value.h"

/// The connectivity of meshes as dictionaries of arrays, and meshes from arrays.
namespace winslow::python {

/// Name of the type -> (elements, corners) int32; polygons: (offsets, nodes); polyhedra: (offsets
/// of elements into the faces, offsets of faces into the nodes, nodes). Read-only, as all below.
pybind11::object cells_of(const Topology& topology);
/// Name of the type -> ids of its elements, in the order of cells_of().
pybind11::object element_ids_of(const Topology& topology);
/// Name of the marker -> its nodes, ascending.
pybind11::object markers_of(const Topology& topology);
/// Name of the marker -> {"line", "triangle", "quad", "polygon": as in cells_of()}.
pybind11::object faces_of(const Topology& topology);
/// Name of the region -> ids of its elements.
pybind11::object regions_of(const Topology& topology);

/// A mesh from arrays that foreign.py has put in order.
/// blocks: list of (name of the type, array), as in cells_of().
/// markers: name -> list of arrays (faces, nodes of a face). regions: name -> ids of elements.
/// Throws MeshError as make_mesh(), UsageError for arrays of the wrong shape.
MeshPointer mesh_from_arrays(const pybind11::object& points, const pybind11::list& blocks,
                             const pybind11::dict& markers, const pybind11::dict& regions);

}  // namespace winslow::python
