#include "python/mesh_value.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.h"
#include "io/format/mesh_format.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/mesh_arrays.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// What `make` makes of the topology, made once.
template <class Make>
py::object once(py::object& kept, const MeshValue& mesh, const Make& make) {
  if (!kept) kept = make(mesh.topology());
  return kept;
}

/// "384 triangles, 12 quads".
std::string elements_text(const Topology& topology) {
  std::array<Index, element_type_count> counts{};
  for (const ElementType type : topology.element_types()) ++counts[static_cast<std::size_t>(type)];
  std::string text;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    if (counts[t] == 0) continue;
    const auto type = static_cast<ElementType>(t);
    text += (text.empty() ? "" : ", ") + std::to_string(counts[t]) + ' ';
    if (type == ElementType::polyhedron)
      text += counts[t] == 1 ? "polyhedron" : "polyhedra";
    else
      text += std::string(cell_name(type)) + (counts[t] == 1 ? "" : "s");
  }
  return text.empty() ? "no elements" : text;
}

std::string repr(const MeshValue& mesh) {
  constexpr std::size_t most = 12;
  const Topology& topology = mesh.topology();
  std::string text = "<winslow.Mesh: " + std::string(mesh_kind(topology)) + ", " +
                     std::to_string(topology.node_count()) + " nodes, " + elements_text(topology);
  const Markers& markers = topology.markers();
  text += "; markers: ";
  for (std::size_t m = 0; m < std::min(markers.size(), most); ++m)
    text += (m > 0 ? ", " : "") + markers[m].name + " (" +
            std::to_string(markers.nodes(static_cast<Index>(m)).size()) + " nodes)";
  if (markers.size() > most) text += " and " + std::to_string(markers.size() - most) + " more";
  if (markers.empty()) text += "none";
  if (!topology.regions().empty())
    text += "; regions: " + listed(topology.regions(), [](const Region& r) { return r.name; });
  return text + '>';
}

/// Whether two names stand for one file or folder.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  const bool same = std::filesystem::equivalent(a, b, error);
  return !error && same;
}

MeshPointer read(const std::filesystem::path& path, int zone, const std::string& regions,
                 const std::string& time, bool repair, bool show) {
  io::ReadOptions options{zone, regions, io::Defects::refuse, time};
  if (show) options.defects = io::Defects::show;
  if (repair) options.defects = io::Defects::repair;
  auto mesh = std::make_shared<MeshValue>();
  mesh->path = path.string();
  const py::gil_scoped_release released;
  mesh->file = io::read_mesh(path, options);
  for (std::string& left : io::zones_left(zone == 0 ? mesh->file.details.get() : nullptr, path))
    mesh->file.warnings.push_back(std::move(left));
  return mesh;
}

std::vector<std::string> write(const MeshPointer& mesh, const std::filesystem::path& path,
                               std::optional<bool> binary, const std::string& gmsh_version,
                               const std::string& cgns_container, bool overwrite) {
  if (!overwrite && !mesh->path.empty() && same_file(path, mesh->path))
    throw UsageError(path.string() +
                     " is the file that the mesh was read from, and would be replaced: name "
                     "another one, or give overwrite=True");
  io::WriteOptions options;
  options.binary = binary.value_or(false);
  options.keep_encoding = !binary;
  options.gmsh_version = gmsh_version;
  options.cgns_container = cgns_container;
  const auto details = mesh->file.details.get();
  options.zone_alone = false;
  const py::gil_scoped_release released;
  return io::write_mesh(path, mesh->mesh(), details, options);
}

MeshPointer with_points(const MeshPointer& mesh, const py::object& points) {
  const Coordinates& own = mesh->mesh().coordinates;
  Coordinates x = coordinates_of(points, own.dimension(), own.size(), "points");
  for (std::size_t k = 0; k < x.values().size(); ++k)
    if (!std::isfinite(x.values()[k]))
      throw UsageError("points: found a coordinate that is not finite at node " +
                       std::to_string(k / static_cast<std::size_t>(x.dimension())));
  return with_coordinates(*mesh, std::move(x));
}

void bind_properties(py::class_<MeshValue, MeshPointer>& mesh) {
  mesh.def_property_readonly(
      "points",
      [](const py::object& self) {
        return view_of(self.cast<const MeshValue&>().mesh().coordinates, self);
      },
      "Coordinates of the nodes: (n, 2) or (n, 3) float64, in the unit of the file.\n\n"
      "A read-only view on the memory of the mesh, which it keeps alive; no copy is made.");
  mesh.def_property_readonly(
      "dimension", [](const MeshValue& m) { return m.mesh().coordinates.dimension(); },
      "2 of a plane mesh, 3 of a surface or volume mesh: the columns of `points`.");
  mesh.def_property_readonly(
      "cell_dimension", [](const MeshValue& m) { return m.topology().cell_dimension(); },
      "Dimension of the elements: 2, of volume meshes 3.");
  mesh.def_property_readonly(
      "kind",
      [](const MeshValue& m) {
        return std::array{"plane", "surface",
                          "volume"}[static_cast<std::size_t>(m.topology().kind())];
      },
      "\"plane\", \"surface\" or \"volume\".");
  mesh.def_property_readonly(
      "node_count", [](const MeshValue& m) { return m.topology().node_count(); },
      "Number of nodes.");
  mesh.def_property_readonly(
      "element_count", [](const MeshValue& m) { return m.topology().element_count(); },
      "Number of elements.");
  mesh.def_property_readonly(
      "cells", [](MeshValue& m) { return once(m.cells, m, cells_of); },
      "Nodes of the elements: dict of the type (meshio's names) to an (m, k) int32 array.\n\n"
      "Polygons are a tuple (offsets, nodes), polyhedra a tuple (offsets of elements into\n"
      "the faces, offsets of faces into the nodes, nodes). Read-only, made once.");
  mesh.def_property_readonly(
      "element_ids", [](MeshValue& m) { return once(m.element_ids, m, element_ids_of); },
      "Ids of the elements of each type, in the order of `cells`: dict to (m,) int32 arrays.");
  mesh.def_property_readonly(
      "markers", [](MeshValue& m) { return once(m.markers, m, markers_of); },
      "Nodes of the markers: dict of the name to an ascending (m,) int32 array.");
  mesh.def_property_readonly(
      "faces", [](MeshValue& m) { return once(m.faces, m, faces_of); },
      "Faces of the markers: dict of the name to a dict of \"line\", \"triangle\", \"quad\" to\n"
      "(m, k) int32 arrays; \"polygon\" to a tuple (offsets, nodes).");
  mesh.def_property_readonly(
      "regions", [](MeshValue& m) { return once(m.regions, m, regions_of); },
      "Elements of the regions: dict of the name to an (m,) int32 array of ids.");
  mesh.def_property_readonly(
      "warnings", [](const MeshValue& m) { return m.file.warnings; },
      "What the reader had to say: a list of sentences.");
  mesh.def_property_readonly(
      "path",
      [](const MeshValue& m) -> py::object {
        return m.path.empty() ? py::object(py::none()) : py::cast(m.path);
      },
      "The file that the mesh was read from; None: it came from arrays.");
  mesh.def_property_readonly(
      "markers_from_file", [](const MeshValue& m) { return m.topology().markers().from_file(); },
      "False where the markers were made up: one for each connected part of the boundary.");
  mesh.def_readwrite("_foreign", &MeshValue::foreign);
}

}  // namespace

MeshPointer with_coordinates(const MeshValue& mesh, Coordinates x) {
  auto moved = std::make_shared<MeshValue>(mesh);
  moved->file.mesh.coordinates = std::move(x);
  return moved;
}

MeshPointer result_mesh(const MeshValue& source, Mesh mesh, bool new_connectivity) {
  if (!new_connectivity) return with_coordinates(source, std::move(mesh.coordinates));
  auto made = std::make_shared<MeshValue>();
  made->file.details = source.file.details;
  made->file.format = source.file.format;
  made->file.mesh = std::move(mesh);
  made->path = source.path;
  return made;
}

void bind_mesh(py::module_& module) {
  py::class_<MeshValue, MeshPointer> mesh(
      module, "Mesh",
      "A mesh: an immutable value.\n\n"
      "Parameters\n----------\n"
      "points : array_like (n, 2) or (n, 3)\n    Coordinates of the nodes.\n"
      "cells : dict or list\n"
      "    Nodes of the elements by their type: {\"triangle\": (m, 3), ...}, or a list of pairs "
      "or\n"
      "    of meshio's CellBlocks. The order of elements is that of the blocks. Types: triangle,\n"
      "    quad, polygon, tetra, pyramid, wedge, hexahedron, polyhedron. Cells of a lower\n"
      "    dimension (line, in volume meshes also triangle, quad) are faces for `markers`.\n"
      "markers : dict, optional\n"
      "    Parts of the boundary: the name to the faces, an (m, 2) array of a plane mesh, or a "
      "list\n"
      "    of arrays for faces with various numbers of nodes. Or cell sets as meshio has them: "
      "the\n"
      "    name to one array of indices for each block; of elements they are regions.\n"
      "regions : dict, optional\n    Sets of elements: the name to ids of elements.\n\n"
      "Raises\n------\n"
      "MeshError\n    For arrays that are no mesh; has `elements` and `nodes`.\n"
      "UsageError\n    For arrays of a wrong shape or type.");
  mesh.def(py::init([](const py::object& points, const py::object& cells, const py::object& markers,
                       const py::object& regions) {
             const auto arrays = py::module_::import("winslow.foreign")
                                     .attr("arrays_of")(cells, markers, regions)
                                     .cast<py::tuple>();
             MeshPointer made = mesh_from_arrays(points, arrays[0], arrays[1], arrays[2]);
             made->foreign = arrays[3];
             return made;
           }),
           py::arg("points"), py::arg("cells"), py::arg("markers") = py::none(),
           py::arg("regions") = py::none());
  bind_properties(mesh);
  mesh.def("__repr__", &repr);
  mesh.def(
      "with_points", &with_points, py::arg("points"),
      "The mesh with other coordinates: (n, dimension), finite. The connectivity is shared.\n\n"
      "A C-contiguous float64 array is read in place; the mesh keeps numbers of its own.");
  mesh.def(
      "copy_points", [](const MeshValue& m) { return array_of(m.mesh().coordinates); },
      "A writable copy of `points`.");
  mesh.def(
      "has_connectivity_of",
      [](const MeshValue& a, const MeshValue& b) {
        return a.file.mesh.topology == b.file.mesh.topology;
      },
      py::arg("other"), "Whether both meshes share one connectivity, as a mesh and its motion do.");
  module.def("read", &read, py::arg("path"), py::arg("zone"), py::arg("regions"), py::arg("time"),
             py::arg("repair"), py::arg("show"));
  module.def("write", &write, py::arg("mesh"), py::arg("path"), py::arg("binary"),
             py::arg("gmsh_version"), py::arg("cgns_container"), py::arg("overwrite"));
}

}  // namespace winslow::python
