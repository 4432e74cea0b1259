#include "app/output/report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "app/output/openfoam_section.h"
#include "app/output/tables.h"
#include "app/output/terminal.h"
#include "core/layers/layer_stack.h"
#include "core/version.h"

namespace winslow::app {

std::int64_t peak_memory_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // KiB on Linux
}

namespace {

using nlohmann::json;

json describe_statistics(const Statistics& s) {
  return {{"min", s.min}, {"avg", s.avg}, {"max", s.max}};  // NaN becomes null
}

/// Writes as many components as the mesh has dimensions.
json describe_place(const Vec3& place, int dimension) {
  json components = json::array();
  for (int k = 0; k < dimension; ++k) components.push_back(place[k]);
  return components;
}

json describe_list(const std::vector<WorstElement>& worst, int dimension) {
  json list = json::array();
  for (const WorstElement& w : worst) {
    list.push_back({{"element", w.element},
                    {"value", w.value},
                    {"centre", describe_place(w.centre, dimension)}});
  }
  return list;
}

std::string unit_of(const FieldInfo& field) {
  return field.unit.empty() ? "1" : std::string(field.unit);
}

json describe_metrics(const QualityReport& quality) {
  json metrics;
  for (const Metric m : reported_metrics(quality.cell_dimension))
    metrics[std::string(metric_name(m))] = describe_statistics(quality.of(m).statistics);
  return metrics;
}

/// The same of the elements of a volume mesh that can move.
json describe_movable(const QualityReport& quality) {
  json metrics;
  for (const Metric m : reported_metrics(quality.cell_dimension))
    metrics[std::string(metric_name(m))] = describe_statistics(quality.of(m).movable);
  return metrics;
}

/// Name and size of each marker; "edges" of a plane or surface mesh, "faces" of a volume mesh.
json describe_markers(const Topology& topology) {
  const std::string faces = std::string(words_of(topology.kind()).face) + 's';
  json list = json::array();
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    const Marker& marker = topology.markers()[m];
    list.push_back({{"name", marker.name},
                    {"nodes", topology.markers().nodes(static_cast<Index>(m)).size()},
                    {faces, marker.faces.size()}});
  }
  return list;
}

json describe_regions(const Topology& topology) {
  std::vector<Index> elements(topology.regions().size(), 0);
  for (const Index region : topology.element_regions())
    if (region >= 0) ++elements[at(region)];
  json list = json::array();
  for (std::size_t r = 0; r < elements.size(); ++r)
    list.push_back({{"name", topology.regions()[r].name}, {"elements", elements[r]}});
  return list;
}

json describe_edges(const EdgePair& edges, int dimension) {
  return {{"moving", edges.moving},
          {"other", edges.other},
          {"place", describe_place(edges.place, dimension)}};
}

json describe_contact(const std::optional<Contact>& contact, int dimension) {
  if (!contact) return {};
  json report = describe_edges(contact->edges, dimension);
  report["fraction"] = contact->fraction;
  return report;
}

json describe_face_angles(const std::optional<FaceAngles>& angles) {
  if (!angles) return nullptr;
  return {{"beyond", angles->beyond}, {"mended", angles->mended}, {"worst", angles->worst}};
}

json describe_layers_held(const std::optional<LayersHeld>& layers) {
  if (!layers) return nullptr;
  return {{"heights", layers->heights}, {"largest_error", layers->error}};
}

json describe_inversion(const std::optional<HeldInversion>& inversion) {
  if (!inversion) return {};
  return {{"element", inversion->element},
          {"fraction", inversion->fraction},
          {"at_end", inversion->at_end}};
}

json describe_gap(const std::optional<Gap>& gap, int dimension) {
  if (!gap) return {};
  json report = describe_edges(gap->edges, dimension);
  report["width"] = gap->width;
  return report;
}

json describe_sliding(const std::vector<SlidingPart>& parts) {
  json report = json::array();
  for (const SlidingPart& part : parts) {
    report.push_back({{part.of_regions ? "regions" : "marker", part.marker},
                      {"on", part.description},
                      {"nodes", part.sliding_nodes()}});
    if (part.gives_way) report.back()["gives_way"] = true;
    if (part.row) report.back()["spacing"] = part.spacing == Spacing::free ? "free" : "held";
  }
  return report;
}

json describe_interfaces(const InterfaceReport& interfaces) {
  json report = json::array();
  for (const InterfaceNodes& nodes : interfaces.each)
    report.push_back({{"regions", nodes.regions},
                      {"held", nodes.held},
                      {"slide", nodes.sliding},
                      {"free", nodes.free}});
  return report;
}

json describe_footholds(const MovingBoundary& boundary) {
  json report = json::array();
  for (const Foothold& foothold : boundary.footholds)
    report.push_back({{"body", foothold.body},
                      {"markers", foothold.markers},
                      {"edge", foothold.edge},
                      {"on", foothold.description},
                      {"nodes", foothold.nodes.size()},
                      {"held_by", json()}});
  for (const HeldFoothold& held : boundary.held_footholds)
    report.push_back({{"body", held.body},
                      {"markers", json::array({held.marker})},
                      {"edge", false},
                      {"on", json()},
                      {"nodes", held.nodes},
                      {"held_by", held.by}});
  return report;
}

json describe_periodic(const std::vector<PeriodicPairs>& list) {
  json report = json::array();
  for (const PeriodicPairs& pairs : list) {
    report.push_back({{"markers", {pairs.first, pairs.second}},
                      {"by", pairs.description},
                      {"pairs", pairs.pairs.size()},
                      {"halo", pairs.halo}});
    if (!pairs.corners.empty()) report.back()["corners"] = pairs.corners.size();
  }
  return report;
}

json describe_result(const CommandRecord& record) {
  const SmoothResult& r = record.result;
  json report = {{"command", record.name},
                 {"description", record.description},
                 {"formulation", record.formulation ? json(*record.formulation) : json()},
                 {"converged", r.converged},
                 {"outer_iterations", r.outer_iterations},
                 {"linear_solves", r.linear_solves},
                 {"residual", r.residual},
                 {"fraction_reached", r.fraction_reached},
                 {"limited_by", r.limited_by.empty() ? json() : json(r.limited_by)},
                 {"contact", describe_contact(r.contact, record.dimension)},
                 {"gap", describe_gap(r.gap, record.dimension)},
                 {"held_inversion", describe_inversion(r.held_inversion)},
                 {"stretched_elements", r.stretched ? json(*r.stretched) : json()},
                 {"kept_outside", r.kept_outside},
                 {"prescribed_inside", r.prescribed_inside},
                 {"layers_held", describe_layers_held(r.layers_held)},
                 {"face_angles", describe_face_angles(r.face_angles)},
                 {"stuck_nodes", r.stuck_nodes},
                 {"nothing_moves", r.nothing_moves},
                 {"without_shape", r.without_shape},
                 {"held_nodes", r.boundary.held},
                 {"sliding", describe_sliding(r.boundary.sliding)},
                 {"interfaces", describe_interfaces(r.boundary.interfaces)},
                 {"footholds", describe_footholds(r.boundary)},
                 {"periodic", describe_periodic(r.boundary.periodic)},
                 {"increments", r.increments},
                 {"linear_solver", r.linear_solver},
                 {"memory_bytes", describe_memory(r.memory)},
                 {"inverted", r.inverted}};
  json pivots = json::array();
  for (const MovingBody& body : record.turned) {
    const GivenVector& pivot = *body.motion.pivot;
    pivots.push_back({{"markers", body.markers},
                      {"pivot", describe_place(pivot, pivot.numbers(record.dimension))}});
  }
  if (pivots.size() == 1) report["pivot"] = pivots[0]["pivot"];
  if (pivots.size() > 1) report["pivots"] = std::move(pivots);
  if (record.zone != 0) report["zone"] = record.zone;
  return report;
}

/// The keys of a whole run: sums over its commands, or values of the last one.
json describe_totals(const std::vector<CommandRecord>& commands) {
  int iterations = 0, solves = 0, increments = 0;
  double fraction = 1;
  json formulation;
  for (const CommandRecord& c : commands) {
    iterations += c.result.outer_iterations;
    solves += c.result.linear_solves;
    increments = std::max(increments, c.result.increments);
    fraction = std::min(fraction, c.result.fraction_reached);
    if (c.formulation) formulation = *c.formulation;
  }
  return {{"formulation", formulation},
          {"converged", all_converged(commands)},
          {"outer_iterations", iterations},
          {"linear_solves", solves},
          {"residual", commands.empty() ? 0.0 : commands.back().result.residual},
          {"fraction_reached", fraction},
          {"increments", increments},
          {"memory_bytes", describe_memory(most_memory(commands))}};
}

}  // namespace

json describe_memory(const MemoryUse& memory) {
  if (memory.total() == 0) return nullptr;
  json report;
  for (const auto& [name, bytes] : memory.parts()) report[std::string(name)] = bytes;
  return report;
}

MemoryUse most_memory(const std::vector<CommandRecord>& commands) {
  MemoryUse most;
  for (const CommandRecord& c : commands)
    if (c.result.memory.total() > most.total()) most = c.result.memory;
  return most;
}

bool all_converged(const std::vector<CommandRecord>& commands) {
  return std::all_of(commands.begin(), commands.end(),
                     [](const CommandRecord& c) { return c.result.converged; });
}

json describe_mesh(const Mesh& mesh, const QualityReport& quality, const QualityReport* before) {
  json inverted = json::array();
  for (const Index e : quality.inverted_elements) {
    inverted.push_back(
        {{"element", e},
         {"centre", describe_place(element_centre(mesh, e), mesh.coordinates.dimension())}});
  }
  json worst, units;
  const int dimension = quality.cell_dimension;
  for (const Metric m : reported_metrics(dimension)) {
    const std::string name(metric_name(m));
    worst[name] = describe_list(quality.of(m).worst, quality.space_dimension);
    units[name] = unit_of(metric_info(m, dimension).field);
  }
  for (const WallField field : all_wall_fields()) {
    if (!quality.has_walls()) break;
    const auto& list = quality.worst_by(field);
    if (list.empty()) continue;
    const FieldInfo& info = wall_field_info(field);
    worst[std::string(info.name)] = describe_list(list, quality.space_dimension);
    units[std::string(info.name)] = unit_of(info);
  }
  json report{{"dimension", dimension},
              {"space_dimension", quality.space_dimension},
              {"nodes", mesh.topology->node_count()},
              {"elements", mesh.topology->element_count()},
              {"markers", describe_markers(*mesh.topology)},
              {"regions", describe_regions(*mesh.topology)},
              {"inverted", quality.inverted},
              {"inverted_elements", inverted},
              {"quality", describe_metrics(quality)},
              {"units", units},
              {"worst", worst}};
  if (quality.has_walls())
    report["walls"] = describe_walls(before ? &before->walls : nullptr, quality.walls, mesh);
  if (dimension == 3) {
    report["all_on_boundary"] = quality.all_on_boundary;
    report["all_on_boundary_inverted"] = quality.all_on_boundary_inverted;
    if (quality.all_on_boundary > 0) report["quality_movable"] = describe_movable(quality);
  }
  if (is_surface(*mesh.topology)) {
    report["folds"] = describe_folds(quality.folds);
    if (before) report["folds_before"] = describe_folds(before->folds);
  }
  if (before) report["quality_before"] = describe_metrics(*before);
  return report;
}

json describe_layers(const LayerStack& stack, const Coordinates& x) {
  const LayerMeasures m = measure_layers(stack, x);
  json cut = json::array(), ends = json::object(), found = json::array();
  std::size_t most = 0, with_layers = 0, rows = 0;
  for (const LayerColumn& column : stack.columns) {
    most = std::max(most, column.count());
    rows += column.count();
    if (column.count() > 0) ++with_layers;
    if (column.end != LayerEnd::none) {
      json& columns = ends[std::string(end_name(column.end))];
      columns = columns.is_null() ? 1 : columns.get<int>() + 1;
      found.push_back(
          {{"node", column.wall_node}, {"rows", column.count()}, {"end", end_name(column.end)}});
    }
    if (!cut_short(column)) continue;
    const Vec3 p = place_of(x, column.wall_node);
    cut.push_back({{"node", column.wall_node},
                   {"at", std::vector<double>(p.data(), p.data() + x.dimension())},
                   {"reason", limit_name(column.limit)},
                   {"layers", column.count()},
                   {"thickness", column.thickness()},
                   {"asked", column.asked}});
  }
  json within;
  for (const double share : {0.01, 0.02, 0.05, 0.1}) {
    const auto near = std::count_if(
        m.columns.begin(), m.columns.end(),
        [&](const ColumnMeasure& c) { return c.thickness > 0 && c.first_error <= share; });
    within[formatted("%g", share)] =
        static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(with_layers, 1));
  }
  return {{"columns", stack.columns.size()},
          {"columns_with_layers", with_layers},
          {"count", most},
          {"rows",
           static_cast<double>(rows) / static_cast<double>(std::max<std::size_t>(with_layers, 1))},
          {"ends", ends},
          {"found", found},
          {"held", stack.held},
          {"first_height", describe_statistics(m.first_height)},
          {"total_thickness", describe_statistics(m.thickness)},
          {"spacing_error", describe_statistics(m.spacing_error)},
          {"first_height_within", within},
          {"first_height_error", describe_statistics(m.first_error)},
          {"orthogonality", describe_statistics(m.orthogonality)},
          {"cut_short", cut}};
}

json describe_surface(const SurfaceChange& change) {
  const auto number = [](const std::optional<double>& value) {
    return value ? json(*value) : json();
  };
  return {{"deviation_from_before", change.from_before},
          {"deviation_from_after", change.from_after},
          {"hausdorff", change.hausdorff()},
          {"extent", change.extent},
          {"volume_before", number(change.volume_before)},
          {"volume_after", number(change.volume_after)}};
}

json describe_zones(const std::vector<ZoneResult>& zones) {
  json list = json::array();
  Index nodes = 0, elements = 0, inverted = 0;
  for (const ZoneResult& z : zones) {
    json block = describe_mesh(*z.mesh, *z.quality, z.before);
    if (z.layers != nullptr) block["layers"] = describe_layers(*z.layers, z.mesh->coordinates);
    if (z.surface != nullptr) block["surface"] = describe_surface(*z.surface);
    if (z.openfoam != nullptr) block["openfoam"] = describe_openfoam_measures(*z.openfoam);
    if (z.periodic != nullptr && !z.periodic->pairs.empty())
      block["periodic_in_file"] = describe_pairs(*z.periodic, *z.mesh);
    if (!z.regions_array.empty()) block["regions_array"] = z.regions_array;
    if (z.zone != 0) block["zone"] = z.zone;
    list.push_back(std::move(block));
    nodes += z.mesh->topology->node_count();
    elements += z.mesh->topology->element_count();
    inverted += z.quality->inverted;
  }
  if (list.size() == 1) return list[0];
  return {{"nodes", nodes}, {"elements", elements}, {"inverted", inverted}, {"zones", list}};
}

void describe_circumstances(json& report, const RunReport& run) {
  report["version"] = WINSLOW_VERSION;
  report["command"] = run.command;
  report["input"] = run.input;
  report["seconds"] = {{"load", run.seconds.load},
                       {"solve", run.seconds.solve},
                       {"save", run.seconds.save},
                       {"total", run.seconds.total}};
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["warnings"] = run.warnings;
}

json describe_run(const RunReport& run, const std::vector<ZoneResult>& zones) {
  json report = describe_zones(zones);
  report.update(describe_totals(run.commands));
  describe_circumstances(report, run);
  report["output"] = run.written ? json(run.output) : json();
  report["commands"] = json::array();
  for (const CommandRecord& c : run.commands) report["commands"].push_back(describe_result(c));
  return report;
}

void write_json(const std::string& path, const json& value) {
  // Names of files and markers need not be UTF-8: replace invalid bytes instead of failing.
  const std::string text = value.dump(2, ' ', false, json::error_handler_t::replace);
  write_text(path, text + '\n');
}

}  // namespace winslow::app
