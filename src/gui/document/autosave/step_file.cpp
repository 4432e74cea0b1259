#include "gui/document/autosave/step_file.h"

#include "core/error.h"
#include "core/strategy/surface_shape.h"
#include "gui/document/autosave/archive.h"
#include "io/file/atomic_file.h"

namespace winslow::gui {

namespace {

/// Also detects a different byte order.
constexpr std::uint64_t magic = 0x000c504554534e57;  // "WNSTEP", version 12

/// Processes every field of a record, for reading and writing.
template <class Archive, class Record>
void record_fields(Archive& archive, Record& r) {
  archive.each(r.iteration, r.residual, r.largest_move, r.inverted, r.min_sine, r.damping,
               r.clipped, r.linear_iterations, r.fraction, r.stage);
}

template <class Archive, class Result>
void result_fields(Archive& archive, Result& r) {
  archive.each(r.converged, r.outer_iterations, r.linear_solves, r.residual, r.out_of_iterations,
               r.fraction_reached, r.increments);
  archive.text(r.linear_solver);
  archive.each(r.inverted, r.stuck_nodes);
}

/// Processes the arrays from which the connectivity is built.
template <class Archive, class Data>
void topology_fields(Archive& archive, Data& data) {
  archive.numbers(data.types);
  archive.numbers(data.element_offsets);
  archive.numbers(data.element_nodes);
  archive.faces(data.faces);
  archive.numbers(data.face_offsets);
  archive.list(data.markers, [](auto& a, auto& marker) {
    a.text(marker.name);
    a.number(marker.tag);
    a.faces(marker.faces);
  });
  archive.list(data.regions, [](auto& a, auto& region) {
    a.text(region.name);
    a.number(region.tag);
  });
  archive.numbers(data.element_region);
}

template <class Archive, class Stack>
void layer_fields(Archive& archive, Stack& stack) {
  archive.list(stack.columns, [](auto& a, auto& column) {
    a.each(column.wall_node, column.wall, column.direction.x(), column.direction.y(),
           column.direction.z(), column.slant, column.along_boundary, column.first, column.asked,
           column.room, column.limit, column.prescribed);
    a.numbers(column.heights);
    a.numbers(column.granted);
    a.number(column.granted_limit);
    a.numbers(column.corrections);
    a.numbers(column.bends);
    a.number(column.end);
    a.numbers(column.nodes);
  });
  archive.numbers(stack.pairs);
  archive.list(stack.faces, [](auto& a, auto& face) {
    for (auto& column : face.columns) a.number(column);
    a.number(face.count);
  });
  archive.numbers(stack.layer_of_element);
  archive.number(stack.held);
}

/// VCV data that differ from equal angles and unit edges.
struct VcvData {
  struct Edit {
    Index node = -1;
    VirtualControlVolumes::Stencil stencil;
  };
  std::vector<Edit> edits;
};

template <class Archive, class Data>
void vcv_fields(Archive& archive, Data& data) {
  archive.list(data.edits, [](auto& a, auto& edit) {
    a.number(edit.node);
    a.numbers(edit.stencil.angles);
    a.numbers(edit.stencil.lengths);
  });
}

/// A hand-edited VCV of a volume mesh.
struct SphereData {
  Index node = -1;
  std::vector<double> directions, lengths;  // x, y, z one after another
};

template <class Archive, class List>
void sphere_fields(Archive& archive, List& list) {
  archive.list(list, [](auto& a, auto& item) {
    a.number(item.node);
    a.numbers(item.directions);
    a.numbers(item.lengths);
  });
}

/// stencils: null for none.
std::vector<SphereData> data_of(const SphereStencils* stencils) {
  std::vector<SphereData> list;
  if (!stencils) return list;
  for (const auto& [node, stencil] : *stencils) {
    SphereData item{node, {}, stencil.lengths};
    for (const Vec3& d : stencil.directions)
      item.directions.insert(item.directions.end(), d.begin(), d.end());
    list.push_back(std::move(item));
  }
  return list;
}

std::shared_ptr<const SphereStencils> made_of(ArchiveReader& reader,
                                              const std::vector<SphereData>& list,
                                              const Topology& topology) {
  SphereStencils stencils;
  for (const SphereData& item : list) {
    std::vector<Vec3> directions;
    if (item.directions.size() % 3 != 0) reader.fail("a direction of two numbers");
    for (std::size_t k = 0; k < item.directions.size(); k += 3)
      directions.emplace_back(item.directions.data() + k);
    // The check does not modify the numbers, which are restored bit by bit.
    checked_stencil(topology, item.node, directions, item.lengths);
    stencils[item.node] = {std::move(directions), item.lengths};
  }
  return stencils.empty() ? nullptr : std::make_shared<const SphereStencils>(std::move(stencils));
}

/// Data that recover the shape of a surface mesh from the given mesh. A reference surface is stored
/// completely, since its file may have been removed or changed.
struct ShapeData {
  FeatureRules rules;
  std::string name;  // of the reference surface in the command; empty: none
  std::string source;
  std::vector<Vec3> points;
  std::vector<Face> faces;
};

template <class Archive, class Data>
void shape_fields(Archive& archive, Data& data) {
  archive.each(data.rules.angle, data.rules.slide_along);
  archive.numbers(data.rules.hold);
  archive.numbers(data.rules.smooth);
  archive.text(data.name);
  archive.text(data.source);
  archive.list(data.points, [](auto& a, auto& point) { a.each(point.x(), point.y(), point.z()); });
  archive.faces(data.faces);
}

ShapeData data_of(const SurfaceShape& shape) {
  ShapeData data{shape.rules, {}, {}, {}, {}};
  if (const ReferenceSurface* surface = shape.reference.get()) {
    data.name = surface->source.empty() ? "surface" : surface->source;
    data.source = surface->source;
    data.points = surface->points;
    data.faces = surface->faces;
  }
  return data;
}

/// before: the input state of the step.
std::shared_ptr<const SurfaceShape> made_of(ShapeData data, const MeshState& before) {
  SlideOptions slide;
  slide.feature_angle = data.rules.angle;
  slide.features = data.rules.slide_along;
  slide.hold_nodes = std::move(data.rules.hold);
  slide.smooth_nodes = std::move(data.rules.smooth);
  SlideFiles files;
  if (!data.name.empty()) {
    auto surface = std::make_shared<ReferenceSurface>();
    surface->source = std::move(data.source);
    surface->points = std::move(data.points);
    surface->faces = std::move(data.faces);
    slide.reference = std::move(data.name);
    files.reference = std::move(surface);
  }
  return surface_shape(before, {std::move(slide), std::move(files)});
}

/// Without coordinates.
MeshData data_of(const Topology& topology) {
  MeshData data;
  std::vector<Face> faces;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto corners = topology.element(e);
    if (topology.element_type(e) != ElementType::polyhedron) {
      data.add_element(topology.element_type(e), corners);
      continue;
    }
    faces.clear();
    for (const Face& face : topology.shape(e).faces) faces.push_back(by_nodes(face, corners));
    data.add_polyhedron(corners, faces);
  }
  // Markers generated for loops are generated again.
  if (topology.markers().from_file()) data.markers = topology.markers().list();
  data.regions = topology.regions();
  data.element_region.assign(topology.element_regions().begin(), topology.element_regions().end());
  return data;
}

VcvData data_of(const VirtualControlVolumes& vcv) {
  VcvData data;
  for (const auto& [node, stencil] : vcv.edits()) data.edits.push_back({node, stencil});
  return data;
}

std::shared_ptr<const VirtualControlVolumes> made_of(
    const VcvData& data, const std::shared_ptr<const Topology>& topology) {
  auto vcv = std::make_shared<VirtualControlVolumes>(topology);
  for (const auto& [node, stencil] : data.edits) vcv->set(node, stencil.angles, stencil.lengths);
  return vcv;
}

/// Which parts of a state are stored.
struct Parts {
  bool topology = false, vcv = false, layers = false, any_layers = false, spheres = false,
       shape = false, roles = false, any_roles = false, reference = false, any_reference = false;
};

template <class Archive, class AnyParts>
void part_fields(Archive& archive, AnyParts& parts) {
  archive.each(parts.topology, parts.vcv, parts.layers, parts.any_layers, parts.spheres,
               parts.shape, parts.roles, parts.any_roles, parts.reference, parts.any_reference);
}

Parts changed_parts(const MeshState& state, const MeshState& before) {
  return {state.mesh.topology != before.mesh.topology, state.vcvs.plane() != before.vcvs.plane(),
          state.layers != before.layers, state.layers != nullptr,
          state.vcvs.by_hand() != before.vcvs.by_hand(),
          // The shape of the mesh as opened is recomputed.
          state.surface && before.mesh.topology && state.surface != before.surface,
          state.roles != before.roles, state.roles != nullptr, state.reference != before.reference,
          state.reference != nullptr};
}

void write_coordinates(ArchiveWriter& writer, const Coordinates& x) {
  writer.number(x.dimension());
  writer.numbers(x.values());
}

void read_coordinates(ArchiveReader& reader, Coordinates& x) {
  int dimension = 0;
  std::vector<double> values;
  reader.number(dimension);
  reader.numbers(values);
  if (dimension < 2 || dimension > 3 || values.size() % static_cast<std::size_t>(dimension) != 0)
    reader.fail(std::to_string(values.size()) + " numbers in " + std::to_string(dimension) +
                " dimensions");
  x = Coordinates(dimension,
                  static_cast<Index>(values.size() / static_cast<std::size_t>(dimension)));
  std::copy(values.begin(), values.end(), x.values().begin());
}

void refuse(ArchiveReader& reader, const std::string& fault) {
  if (!fault.empty()) reader.fail(fault);
}

std::shared_ptr<const Topology> read_topology(ArchiveReader& reader, const Coordinates& x) {
  MeshData data;
  topology_fields(reader, data);
  data.coordinates = x;
  refuse(reader, fault_of(data));
  return Topology::build(data);
}

/// Null if the state has none.
std::shared_ptr<const Coordinates> read_reference(ArchiveReader& reader, const Parts& parts,
                                                  const Coordinates& mesh) {
  if (!parts.any_reference) return nullptr;
  auto reference = std::make_shared<Coordinates>();
  read_coordinates(reader, *reference);
  if (!reference->alike(mesh)) reader.fail("a reference mesh of other nodes than the mesh");
  return reference;
}

/// The state before, updated with the stored parts.
MeshState read_state(ArchiveReader& reader, const MeshState& before) {
  MeshState state = before;
  read_coordinates(reader, state.mesh.coordinates);
  Parts parts;
  part_fields(reader, parts);
  if (parts.topology) state.mesh.topology = read_topology(reader, state.mesh.coordinates);
  if (!state.mesh.topology) reader.fail("no elements");
  const Topology& topology = *state.mesh.topology;
  if (state.mesh.coordinates.dimension() != topology.space_dimension())
    reader.fail("points of another dimension than the mesh has");
  if (state.mesh.coordinates.size() != topology.node_count())
    reader.fail(std::to_string(state.mesh.coordinates.size()) + " nodes of " +
                std::to_string(topology.node_count()));
  // Data that belong to elements cannot be unchanged if the elements have changed. Volume meshes
  // have no VirtualControlVolumes.
  const bool without_vcv = topology.cell_dimension() == 2 && !parts.vcv;
  if (parts.topology &&
      (without_vcv || (state.layers && !parts.layers) || (state.roles && !parts.roles)))
    reader.fail("other elements without their control volumes, layers or roles");
  if (parts.vcv) {
    VcvData data;
    vcv_fields(reader, data);
    state.vcvs = made_of(data, state.mesh.topology);
  }
  if (parts.spheres) {
    std::vector<SphereData> list;
    sphere_fields(reader, list);
    if (topology.cell_dimension() != 3) reader.fail("solid angles of a mesh that has none");
    state.vcvs = made_of(reader, list, topology);
  }
  if (parts.shape) {
    ShapeData data;
    shape_fields(reader, data);
    refuse(reader, fault_of_surface(data.points, data.faces));
    if (!is_surface(topology)) reader.fail("the shape of a surface that the mesh is not");
    state.surface = made_of(std::move(data), before);
  }
  if (parts.roles) {
    state.roles.reset();
    if (parts.any_roles) {
      ElementRoles roles;
      reader.numbers(roles);
      refuse(reader, fault_of(roles, topology));
      state.roles = std::make_shared<const ElementRoles>(std::move(roles));
    }
  }
  if (parts.layers) {
    state.layers.reset();
    if (parts.any_layers) {
      LayerStack stack;
      layer_fields(reader, stack);
      refuse(reader, fault_of(stack, topology));
      state.layers = std::make_shared<const LayerStack>(std::move(stack));
    }
  }
  if (parts.reference) state.reference = read_reference(reader, parts, state.mesh.coordinates);
  state.held_walls.clear();
  reader.list(state.held_walls, [](auto& a, auto& name) { a.text(name); });
  return state;
}

}  // namespace

void write_step(const std::filesystem::path& path, const MeshState& state, const MeshState& before,
                const SmoothResult& smooth) {
  io::write_atomically(path, [&](std::ostream& out) {
    ArchiveWriter writer(out);
    writer.number(magic);
    write_coordinates(writer, state.mesh.coordinates);
    const Parts parts = changed_parts(state, before);
    part_fields(writer, parts);
    if (parts.topology) {
      const MeshData data = data_of(*state.mesh.topology);
      topology_fields(writer, data);
    }
    if (parts.vcv) {
      const VcvData data = data_of(*state.vcvs.plane());
      vcv_fields(writer, data);
    }
    if (parts.spheres) {
      const std::vector<SphereData> list = data_of(state.vcvs.by_hand().get());
      sphere_fields(writer, list);
    }
    if (parts.shape) {
      const ShapeData data = data_of(*state.surface);
      shape_fields(writer, data);
    }
    if (parts.roles && parts.any_roles) writer.numbers(*state.roles);
    if (parts.layers && parts.any_layers) layer_fields(writer, *state.layers);
    if (parts.reference && parts.any_reference) write_coordinates(writer, *state.reference);
    writer.list(state.held_walls, [](auto& a, auto& name) { a.text(name); });
    result_fields(writer, smooth);
    writer.list(smooth.history, [](auto& a, auto& record) { record_fields(a, record); });
    writer.finish();
  });
}

CommandResult read_step(const std::filesystem::path& path, const MeshState& before) {
  const std::string bytes = checked_content(path);
  ArchiveReader reader(bytes, path);
  std::uint64_t found = 0;
  reader.number(found);
  if (found != magic) reader.fail("something else");
  CommandResult step;
  try {
    step.state = read_state(reader, before);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {  // the numbers define no valid mesh or VCVs
    reader.fail(error.what());
  }
  result_fields(reader, step.smooth);
  reader.list(step.smooth.history, [](auto& a, auto& record) { record_fields(a, record); });
  if (!reader.empty()) reader.fail("more than one");
  return step;
}

namespace {

bool within(Index value, Index count) { return value >= 0 && value < count; }

bool positive(double value) { return value > 0 && std::isfinite(value); }

bool all_positive(const std::vector<double>& values) {
  return std::ranges::all_of(values, positive);
}

bool face_rows_fit(const MeshData& data) {
  const auto& offsets = data.face_offsets;
  if (offsets.empty())
    return data.faces.empty() && std::ranges::count(data.types, ElementType::polyhedron) == 0;
  return offsets.size() == data.types.size() + 1 && offsets.front() == 0 &&
         std::ranges::is_sorted(offsets) &&
         static_cast<std::size_t>(offsets.back()) == data.faces.size();
}

bool element_rows_fit(const MeshData& data) {
  const auto& offsets = data.element_offsets;
  if (offsets.size() != data.types.size() + 1 || offsets.front() != 0) return false;
  for (std::size_t e = 0; e < data.types.size(); ++e) {
    if (static_cast<std::size_t>(data.types[e]) >= element_type_count) return false;
    // The order of the checks avoids overflow of damaged numbers.
    if (offsets[e] < 0 || offsets[e + 1] < offsets[e]) return false;
    if (data.types[e] != ElementType::polyhedron && data.types[e] != ElementType::polygon &&
        offsets[e + 1] - offsets[e] != corner_count(data.types[e]))
      return false;
  }
  return static_cast<std::size_t>(offsets.back()) == data.element_nodes.size() &&
         face_rows_fit(data);
}

std::string fault_of_column(const LayerColumn& column, Index nodes) {
  if (!within(column.wall_node, nodes) || column.wall < 0) return "a column on no wall";
  if (!column.direction.allFinite() || !positive(column.slant)) return "a column without direction";
  for (const double value : {column.first, column.asked, column.room})
    if (!std::isfinite(value)) return "a height that is no number";
  for (const LayerLimit limit : {column.limit, column.granted_limit})
    if (limit < LayerLimit::none || limit > LayerLimit::room) return "a reason that does not exist";
  for (const auto* heights : {&column.heights, &column.granted, &column.corrections})
    if (!all_positive(*heights)) return "a height that is not positive";
  if (!column.granted.empty() && column.granted.size() != column.count())
    return std::to_string(column.granted.size()) + " granted heights of " +
           std::to_string(column.count());
  if (!column.corrections.empty() && column.corrections.size() != column.count())
    return std::to_string(column.corrections.size()) + " corrections of " +
           std::to_string(column.count()) + " heights";
  if (column.end < LayerEnd::none || column.end > LayerEnd::count)
    return "a reason that does not exist";
  if (!column.bends.empty() && column.bends.size() != column.count())
    return std::to_string(column.bends.size()) + " bends of " + std::to_string(column.count()) +
           " heights";
  if (!std::ranges::all_of(column.bends, [](double bend) { return std::isfinite(bend); }))
    return "a bend that is no number";
  if (column.nodes.size() != column.count() + 1 || column.nodes.front() != column.wall_node)
    return std::to_string(column.nodes.size()) + " nodes in a column of " +
           std::to_string(column.count()) + " layers";
  if (!std::ranges::all_of(column.nodes, [&](Index node) { return within(node, nodes); }))
    return "a column through no node of the mesh";
  return {};
}

}  // namespace

std::string fault_of(const MeshData& data) {
  if (!element_rows_fit(data)) return "elements that do not fit their nodes";
  for (const Marker& marker : data.markers)
    for (const Face& face : marker.faces)
      if (face.size() < 2 ||
          !std::ranges::all_of(face, [&](Index node) { return within(node, data.node_count()); }))
        return "a face of a marker between no nodes of the mesh";
  if (!data.element_region.empty() && data.element_region.size() != data.types.size())
    return "regions of " + std::to_string(data.element_region.size()) + " elements";
  const auto regions = static_cast<Index>(data.regions.size());
  if (!std::ranges::all_of(data.element_region,
                           [&](Index region) { return region == -1 || within(region, regions); }))
    return "an element in a region that does not exist";
  return {};
}

std::string fault_of_surface(const std::vector<Vec3>& points, const std::vector<Face>& faces) {
  if (!std::ranges::all_of(points, [](const Vec3& point) { return point.allFinite(); }))
    return "a point of a surface that is no place";
  const auto count = static_cast<Index>(points.size());
  for (const Face& face : faces)
    if (face.size() < 3 ||
        !std::ranges::all_of(face, [&](Index point) { return within(point, count); }))
      return "a face of a surface between no points of it";
  return {};
}

std::string fault_of(const LayerStack& stack, const Topology& topology) {
  if (stack.columns.empty()) return "layers without columns";
  std::size_t most = 0;
  for (const LayerColumn& column : stack.columns) {
    if (std::string fault = fault_of_column(column, topology.node_count()); !fault.empty())
      return fault;
    most = std::max(most, column.count());
  }
  for (const ColumnPair& pair : stack.pairs)
    if (pair.left >= stack.columns.size() || pair.right >= stack.columns.size())
      return "neighbours of a column that does not exist";
  for (const ColumnFace& face : stack.faces) {
    if (face.count != 3 && face.count != 4)
      return "a face of a wall between " + std::to_string(face.count) + " columns";
    for (const std::size_t column : face.corners())
      if (column >= stack.columns.size()) return "a face between columns that do not exist";
  }
  if (stack.layer_of_element.size() != static_cast<std::size_t>(topology.element_count()))
    return "layers of " + std::to_string(stack.layer_of_element.size()) + " elements";
  for (const int layer : stack.layer_of_element)
    if (layer < -1 || layer >= static_cast<int>(most))
      return "an element in a layer that does not exist";
  return {};
}

std::string fault_of(const ElementRoles& roles, const Topology& topology) {
  if (std::ssize(roles) != topology.element_count())
    return std::to_string(roles.size()) + " roles of " + std::to_string(topology.element_count()) +
           " elements";
  const bool known = std::ranges::all_of(
      roles, [](ElementRole role) { return role <= ElementRole::beside_layers; });
  return known ? "" : "a role that does not exist";
}

}  // namespace winslow::gui
