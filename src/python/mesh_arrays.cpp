#include "python/mesh_arrays.h"

#include "core/error.h"
#include "python/arrays.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

constexpr std::array<std::string_view, element_type_count> names{
    "triangle", "quad", "tetra", "pyramid", "wedge", "hexahedron", "polyhedron", "polygon"};

py::str text(std::string_view of) { return {of.data(), of.size()}; }

/// A dictionary that cannot be changed.
py::object read_only(const py::dict& dictionary) {
  return py::module_::import("types").attr("MappingProxyType")(dictionary);
}

/// The number of elements of each type.
std::array<std::size_t, element_type_count> counts_of(const Topology& topology) {
  std::array<std::size_t, element_type_count> counts{};
  for (const ElementType type : topology.element_types()) ++counts[static_cast<std::size_t>(type)];
  return counts;
}

template <class Visit>
void for_elements(const Topology& topology, ElementType type, const Visit& visit) {
  for (Index e = 0; e < topology.element_count(); ++e)
    if (topology.element_type(e) == type) visit(e);
}

py::object rows_of_type(const Topology& topology, ElementType type, std::size_t count) {
  std::vector<Index> nodes;
  const auto corners = static_cast<std::size_t>(corner_count(type));
  nodes.reserve(count * corners);
  for_elements(topology, type, [&](Index e) {
    const auto element = topology.element(e);
    nodes.insert(nodes.end(), element.begin(), element.end());
  });
  return frozen(std::move(nodes),
                {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(corners)});
}

py::object polygons_of(const Topology& topology) {
  CompressedRows rows;
  for_elements(topology, ElementType::polygon, [&](Index e) {
    const auto element = topology.element(e);
    rows.values.insert(rows.values.end(), element.begin(), element.end());
    rows.end_row();
  });
  return py::make_tuple(frozen(std::move(rows.offsets)), frozen(std::move(rows.values)));
}

py::object polyhedra_of(const Topology& topology) {
  CompressedRows faces;
  std::vector<Index> elements{0};
  for_elements(topology, ElementType::polyhedron, [&](Index e) {
    for (const Face& local : topology.shape(e).faces) {
      const Face face = by_nodes(local, topology.element(e));
      faces.values.insert(faces.values.end(), face.begin(), face.end());
      faces.end_row();
    }
    elements.push_back(faces.rows());
  });
  return py::make_tuple(frozen(std::move(elements)), frozen(std::move(faces.offsets)),
                        frozen(std::move(faces.values)));
}

/// The faces of a marker by their number of corners.
py::object faces_by_type(const Marker& marker) {
  constexpr std::array<const char*, 5> types{"", "", "line", "triangle", "quad"};
  py::dict by_type;
  for (std::size_t corners = 2; corners < types.size(); ++corners) {
    std::vector<Index> nodes;
    for (const Face& face : marker.faces)
      if (face.size() == corners) nodes.insert(nodes.end(), face.begin(), face.end());
    if (nodes.empty()) continue;
    const auto columns = static_cast<py::ssize_t>(corners);
    const auto rows = static_cast<py::ssize_t>(nodes.size()) / columns;
    by_type[types[corners]] = frozen(std::move(nodes), {rows, columns});
  }
  CompressedRows rows;
  for (const Face& face : marker.faces) {
    if (face.size() < types.size()) continue;
    rows.values.insert(rows.values.end(), face.begin(), face.end());
    rows.end_row();
  }
  if (rows.rows() > 0)
    by_type["polygon"] =
        py::make_tuple(frozen(std::move(rows.offsets)), frozen(std::move(rows.values)));
  return read_only(by_type);
}

// Meshes from arrays.

InputArray<Index> ids_of(const py::handle& given, const std::string& what) {
  const auto as_object = py::reinterpret_borrow<py::object>(given);
  const py::array any = py::array::ensure(as_object);
  // An array of floating-point numbers would be cut to whole ones.
  if (!any || (any.size() > 0 && any.dtype().kind() != 'i' && any.dtype().kind() != 'u')) {
    PyErr_Clear();
    throw UsageError(what + ": expected an array of whole numbers");
  }
  InputArray<Index> array = InputArray<Index>::ensure(as_object);
  if (!array) throw py::error_already_set();
  // Numbers beyond 2^31 would be wrapped.
  if (any.itemsize() > 4 && any.size() > 0 && !any.attr("__eq__")(array).attr("all")().cast<bool>())
    throw UsageError(what + ": found a number that is too large for a node, expected at most 2^31");
  return array;
}

ElementType type_named(const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw UsageError("cells: found \"" + name + "\", expected one of " +
                     listed(names, [](std::string_view known) { return known; }));
  return static_cast<ElementType>(found - names.begin());
}

/// Two or three arrays of a tuple, each of one dimension.
std::vector<InputArray<Index>> rows_in(const py::handle& given, std::size_t count,
                                       const std::string& what) {
  if (!py::isinstance<py::tuple>(given) && !py::isinstance<py::list>(given))
    throw UsageError(what + ": expected a tuple of " + std::to_string(count) +
                     " arrays: offsets and nodes");
  std::vector<InputArray<Index>> arrays;
  for (const py::handle part : given) arrays.push_back(ids_of(part, what));
  bool sound = arrays.size() == count;
  for (std::size_t k = 0; sound && k < count; ++k) {
    sound = arrays[k].ndim() == 1;
    if (!sound || k + 1 == count) continue;
    const InputArray<Index>& offsets = arrays[k];
    const py::ssize_t last = k + 2 == count ? arrays[k + 1].size() : arrays[k + 1].size() - 1;
    sound = offsets.size() > 0 && *offsets.data() == 0 &&
            *(offsets.data() + offsets.size() - 1) == last &&
            std::is_sorted(offsets.data(), offsets.data() + offsets.size());
  }
  if (!sound)
    throw UsageError(what + ": expected " + std::to_string(count) +
                     " arrays, of which all but the last are ascending offsets, from 0 to the "
                     "length of what they divide");
  return arrays;
}

void add_polygons(const py::handle& given, MeshData& data) {
  const auto arrays = rows_in(given, 2, "cells[\"polygon\"]");
  const Index* offsets = arrays[0].data();
  for (py::ssize_t e = 0; e + 1 < arrays[0].size(); ++e)
    data.add_element(ElementType::polygon,
                     {arrays[1].data() + offsets[e], arrays[1].data() + offsets[e + 1]});
}

void add_polyhedra(const py::handle& given, MeshData& data) {
  const auto arrays = rows_in(given, 3, "cells[\"polyhedron\"]");
  const Index *elements = arrays[0].data(), *offsets = arrays[1].data();
  for (py::ssize_t e = 0; e + 1 < arrays[0].size(); ++e) {
    std::vector<Face> faces;
    for (Index f = elements[e]; f < elements[e + 1]; ++f)
      faces.emplace_back(
          std::span<const Index>(arrays[2].data() + offsets[f], arrays[2].data() + offsets[f + 1]));
    data.add_polyhedron(faces);
  }
}

void add_block(const std::string& name, const py::handle& given, MeshData& data) {
  const ElementType type = type_named(name);
  if (type == ElementType::polygon) return add_polygons(given, data);
  if (type == ElementType::polyhedron) return add_polyhedra(given, data);
  const std::string what = "cells[\"" + name + "\"]";
  const InputArray<Index> array = ids_of(given, what);
  const auto corners = static_cast<std::size_t>(corner_count(type));
  if (array.ndim() != 2 || array.shape(1) != corner_count(type))
    throw UsageError(what + ": expected an array (elements, " + std::to_string(corners) + ")");
  for (py::ssize_t e = 0; e < array.shape(0); ++e)
    data.add_element(type, {array.data() + e * array.shape(1), corners});
}

void add_marker(const std::string& name, const py::handle& arrays, MeshData& data) {
  Marker marker{name, static_cast<int>(data.markers.size()) + 1, {}};
  const std::string what = "markers[\"" + name + "\"]";
  for (const py::handle given : arrays) {
    const InputArray<Index> array = ids_of(given, what);
    if (array.size() == 0) continue;
    if (array.ndim() != 2 || array.shape(1) < 2)
      throw UsageError(what + ": expected an array (faces, nodes of a face)");
    for (py::ssize_t f = 0; f < array.shape(0); ++f)
      marker.faces.emplace_back(std::span<const Index>(array.data() + f * array.shape(1),
                                                       static_cast<std::size_t>(array.shape(1))));
  }
  data.markers.push_back(std::move(marker));
}

void add_region(const std::string& name, const py::handle& given, MeshData& data) {
  const std::string what = "regions[\"" + name + "\"]";
  const auto number = static_cast<Index>(data.regions.size());
  data.regions.push_back({name, number + 1});
  data.element_region.resize(at(data.element_count()), -1);
  const InputArray<Index> ids = ids_of(given, what);
  for (const Index* e = ids.data(); e != ids.data() + ids.size(); ++e) {
    if (*e < 0 || *e >= data.element_count())
      throw UsageError(what + ": found element " + std::to_string(*e) + ", expected 0 to " +
                       std::to_string(data.element_count() - 1));
    if (data.element_region[at(*e)] >= 0)
      throw UsageError(what + ": element " + std::to_string(*e) + " is also in the region \"" +
                       data.regions[at(data.element_region[at(*e)])].name +
                       "\", expected an element in one region");
    data.element_region[at(*e)] = number;
  }
}

}  // namespace

std::string_view cell_name(ElementType type) { return names[static_cast<std::size_t>(type)]; }

py::object cells_of(const Topology& topology) {
  const auto counts = counts_of(topology);
  py::dict cells;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    if (counts[t] == 0) continue;
    const auto type = static_cast<ElementType>(t);
    if (type == ElementType::polygon)
      cells[text(names[t])] = polygons_of(topology);
    else if (type == ElementType::polyhedron)
      cells[text(names[t])] = polyhedra_of(topology);
    else
      cells[text(names[t])] = rows_of_type(topology, type, counts[t]);
  }
  return read_only(cells);
}

py::object element_ids_of(const Topology& topology) {
  const auto counts = counts_of(topology);
  py::dict all;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    if (counts[t] == 0) continue;
    std::vector<Index> ids;
    for_elements(topology, static_cast<ElementType>(t), [&](Index e) { ids.push_back(e); });
    all[text(names[t])] = frozen(std::move(ids));
  }
  return read_only(all);
}

py::object markers_of(const Topology& topology) {
  py::dict all;
  const Markers& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    all[text(markers[m].name)] = frozen(std::vector<Index>(nodes.begin(), nodes.end()));
  }
  return read_only(all);
}

py::object faces_of(const Topology& topology) {
  py::dict all;
  for (const Marker& marker : topology.markers()) all[text(marker.name)] = faces_by_type(marker);
  return read_only(all);
}

py::object regions_of(const Topology& topology) {
  std::vector<std::vector<Index>> ids(topology.regions().size());
  const auto of_element = topology.element_regions();
  for (std::size_t e = 0; e < of_element.size(); ++e)
    if (of_element[e] >= 0) ids[at(of_element[e])].push_back(static_cast<Index>(e));
  py::dict all;
  for (std::size_t r = 0; r < ids.size(); ++r)
    all[text(topology.regions()[r].name)] = frozen(std::move(ids[r]));
  return read_only(all);
}

MeshPointer mesh_from_arrays(const py::object& points, const py::list& blocks,
                             const py::dict& markers, const py::dict& regions) {
  MeshData data;
  data.coordinates = coordinates_of(points, "points");
  for (const py::handle block : blocks) {
    const auto pair = py::cast<py::tuple>(block);
    add_block(pair[0].cast<std::string>(), pair[1], data);
  }
  for (const auto& [name, arrays] : markers) add_marker(py::cast<std::string>(name), arrays, data);
  for (const auto& [name, ids] : regions) add_region(py::cast<std::string>(name), ids, data);
  auto value = std::make_shared<MeshValue>();
  const py::gil_scoped_release released;
  value->file.mesh = make_mesh(data, &value->file.warnings);
  return value;
}

}  // namespace winslow::python
