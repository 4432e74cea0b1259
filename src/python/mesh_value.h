#pragma once

#include <pybind11/pybind11.h>

#include "core/mesh/mesh.h"
#include "io/format/mesh_file.h"

/// The class winslow.Mesh: a mesh as an immutable value.
namespace winslow::python {

/// A mesh, and what its file says besides. Meshes that come from one another share what does not
/// change: the connectivity, the details of the file.
struct MeshValue {
  io::MeshFile file;  ///< of a mesh that came from no file: without a format and details
  std::string path;   ///< the file as it was named; empty: none
  /// What a foreign mesh (meshio, pyvista) holds besides: data, the order of its cells. None: it
  /// came from nowhere else. For foreign.py alone.
  pybind11::object foreign = pybind11::none();

  // Made when they are asked for first.
  pybind11::object cells, element_ids, markers, faces, regions;

  const Mesh& mesh() const { return file.mesh; }
  const Topology& topology() const { return *file.mesh.topology; }
};
using MeshPointer = std::shared_ptr<MeshValue>;

/// The same mesh with other coordinates. Needs the GIL.
MeshPointer with_coordinates(const MeshValue& mesh, Coordinates x);
/// The mesh that a command made of another one. new_connectivity: it keeps nothing of what is known
/// of single nodes and elements. Needs the GIL.
MeshPointer result_mesh(const MeshValue& source, Mesh mesh, bool new_connectivity);

/// Adds Mesh, read and write to the module.
void bind_mesh(pybind11::module_& module);

/// "triangle", "quad", "tetra", "wedge": the names of numpy users, which are meshio's.
std::string_view cell_name(ElementType type);

}  // namespace winslow::python
