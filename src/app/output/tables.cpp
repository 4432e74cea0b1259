#include "app/output/tables.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "app/output/terminal.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/coordinates.h"

namespace winslow::app {
namespace {

constexpr int bar_width = 50;

/// Formats with three decimals; very small and very large numbers in scientific notation. NaN: what
/// was not measured.
std::string number(double value) {
  if (std::isnan(value)) return formatted("%11s", "-");
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 0.01 && size < 1e5);
  return formatted(plain ? "%11.3f" : "%11.3e", value);
}

std::string counted(Index n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

void print_list(std::ostream& out, const FieldInfo& field, const std::vector<WorstElement>& worst,
                int dimension) {
  if (worst.empty()) return;
  out << "\nWorst elements by " << field.label << '\n'
      << formatted("%11s%11s   %s\n", "element", "value", "centre");
  for (const WorstElement& w : worst) {
    out << formatted("%11d", static_cast<int>(w.element)) << number(w.value) << "   "
        << place_text(w.centre, dimension) << '\n';
  }
}

}  // namespace

void print_zone_heading(std::ostream& out, const std::string& name) {
  if (!name.empty()) out << name << '\n';
}

void print_memory(std::ostream& out, const MemoryUse& memory, std::int64_t peak) {
  constexpr double megabyte = 1e6;
  const auto line = [&](std::string_view name, double bytes) {
    out << formatted("  %-16s%10.1f MB\n", std::string(name).c_str(), bytes / megabyte);
  };
  out << formatted("Memory: at most %.1f MB\n", static_cast<double>(peak) / megabyte);
  for (const auto& [name, bytes] : memory.parts())
    if (bytes > 0) line(name, static_cast<double>(bytes));
  const double rest = static_cast<double>(peak) - static_cast<double>(memory.total());
  if (memory.total() > 0 && rest > 0) line("not counted", rest);
}

namespace {

/// A line for each metric.
/// which: PerMetric::statistics or PerMetric::movable.
void print_statistics(std::ostream& out, const QualityReport& quality,
                      Statistics QualityReport::PerMetric::*which) {
  for (const Metric metric : reported_metrics(quality.cell_dimension)) {
    const Statistics& s = quality.of(metric).*which;
    const auto& field = metric_info(metric, quality.cell_dimension).field;
    out << formatted("%-22s", std::string(field.label).c_str()) << number(s.min) << number(s.avg)
        << number(s.max)
        << (std::isnan(s.avg) ? "  not measured: infinite in every element\n" : "\n");
  }
}

}  // namespace

void print_quality_table(std::ostream& out, const Mesh& mesh, const QualityReport& quality) {
  out << formatted("%-22s%11s%11s%11s\n", "", "minimum", "average", "maximum");
  print_statistics(out, quality, &QualityReport::PerMetric::statistics);
  out << counted(mesh.topology->node_count(), "node", "nodes") << ", "
      << counted(mesh.topology->element_count(), "element", "elements") << ", " << quality.inverted
      << " inverted\n";
  if (quality.all_on_boundary == 0) return;
  out << counted(quality.all_on_boundary, "element has", "elements have")
      << " all nodes on the boundary and cannot move";
  if (quality.all_on_boundary_inverted > 0)
    out << " (" << quality.all_on_boundary_inverted << " inverted)";
  if (quality.all_on_boundary == quality.elements) {
    out << ": smoothing changes nothing unless boundary nodes slide (--slide NAME)\n";
    return;
  }
  out << "; without them:\n";
  print_statistics(out, quality, &QualityReport::PerMetric::movable);
}

void print_regions(std::ostream& out, const Topology& topology, const std::string& array) {
  if (array.empty()) return;
  out << counted(static_cast<Index>(topology.regions().size()), "region", "regions")
      << ", by the cell array " << printable(array) << '\n';
}

void print_surface_change(std::ostream& out, const SurfaceChange& change) {
  out << "largest deviation: " << formatted("%.3g", change.from_before)
      << " from the surface as given to the new one, " << formatted("%.3g", change.from_after)
      << " back (" << formatted("%.2g", change.hausdorff() / change.extent)
      << " of the extent, at nodes and middles of edges and elements)\n";
  if (change.volume_before && change.volume_after)
    out << "enclosed volume: " << formatted("%.9g", *change.volume_before) << " before, "
        << formatted("%.9g", *change.volume_after) << " after ("
        << formatted("%+.2g", 100 * (*change.volume_after / *change.volume_before - 1)) << " %)\n";
}

void print_worst_elements(std::ostream& out, const QualityReport& quality) {
  for (const Metric m : reported_metrics(quality.cell_dimension))
    print_list(out, metric_info(m, quality.cell_dimension).field, quality.of(m).worst,
               quality.space_dimension);
  if (!quality.has_walls()) return;
  for (const WallField field : all_wall_fields())
    print_list(out, wall_field_info(field), quality.worst_by(field), quality.space_dimension);
}

void print_inverted_elements(std::ostream& out, const Mesh& mesh, const QualityReport& quality,
                             int limit) {
  const auto shown = std::min<std::size_t>(quality.inverted_elements.size(),
                                           static_cast<std::size_t>(std::max(limit, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    const Index e = quality.inverted_elements[i];
    out << "  element " << e << " at "
        << place_text(element_centre(mesh, e), mesh.coordinates.dimension()) << '\n';
  }
  const Index left = quality.inverted - static_cast<Index>(shown);
  if (left > 0) out << "  and " << left << " more\n";
}

void print_folds(std::ostream& out, const SurfaceFolds& folds, int limit) {
  if (!folds.any()) return;
  std::string text = describe(folds);
  text.front() = 'T';
  out << text << '\n';
  const auto shown =
      std::min<std::size_t>(folds.places.size(), static_cast<std::size_t>(std::max(limit, 0)));
  for (const SurfaceFolds::Edge& edge : std::span(folds.places).first(shown)) {
    out << "  edge " << edge.nodes[0] << ' ' << edge.nodes[1] << " between elements "
        << edge.elements[0] << " and " << edge.elements[1] << " at " << place_text(edge.centre)
        << '\n';
  }
  const Index left = folds.edges - static_cast<Index>(shown);
  if (left > 0) out << "  and " << left << " more\n";
  out << "Triangles of a surface that was read from a file have no side that is wrong, so these do "
         "not count as inverted.\nWith --reference-surface FILE, a surface without folds, smooth "
         "turns "
         "them back.\n";
}

nlohmann::json describe_folds(const SurfaceFolds& folds) {
  nlohmann::json places = nlohmann::json::array();
  for (const SurfaceFolds::Edge& edge : folds.places)
    places.push_back({{"nodes", edge.nodes},
                      {"elements", edge.elements},
                      {"centre", {edge.centre.x(), edge.centre.y(), edge.centre.z()}}});
  return {{"edges", folds.edges},
          {"elements", folds.elements},
          {"thin_edges", folds.thin_edges},
          {"places", places},
          {"behind", folds.behind}};
}

void print_histograms(std::ostream& out, const QualityReport& quality) {
  for (const Metric m : reported_metrics(quality.cell_dimension)) {
    const Histogram& h = quality.of(m).histogram;
    if (h.counts.empty()) continue;
    const Index most = std::max<Index>(1, *std::max_element(h.counts.begin(), h.counts.end()));
    const double width = (h.high - h.low) / static_cast<double>(h.counts.size());
    out << '\n' << metric_info(m, quality.cell_dimension).field.label << '\n';
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
      const double low = h.low + width * static_cast<double>(i);
      const int bar =
          static_cast<int>((static_cast<long>(h.counts[i]) * bar_width + most - 1) / most);
      out << formatted("%9.3f to %9.3f %9d ", low, low + width, static_cast<int>(h.counts[i]))
          << std::string(static_cast<std::size_t>(bar), '#') << '\n';
    }
  }
}

namespace {

using nlohmann::json;

/// A quantity that is measured at walls.
struct Measure {
  const char* key;    ///< in the report
  const char* label;  ///< in the table
  Quantiles WallReport::*of;
};

constexpr std::array measures{
    Measure{"first_height", "First height", &WallReport::first_height},
    Measure{"tilt", "Tilt, degrees", &WallReport::tilt},
    Measure{"growth", "Growth", &WallReport::growth},
    Measure{"size_ratio", "Size ratio", &WallReport::size_ratio},
};

void print_row(std::ostream& out, const std::string& name, const Quantiles& q) {
  if (q.count == 0) return;
  out << formatted("%-22s%11.4g%11.4g%11.4g%11.4g%11.4g\n", name.c_str(), q.min, q.low, q.median,
                   q.high, q.max);
}

json describe_quantiles(const Quantiles& q) {
  if (q.count == 0) return {};
  return {{"min", q.min}, {"p05", q.low}, {"median", q.median}, {"p95", q.high}, {"max", q.max}};
}

json describe_all(const WallReport& report) {
  json block;
  for (const Measure& measure : measures)
    block[measure.key] = describe_quantiles(report.*measure.of);
  return block;
}

json describe_one(const WallMeasures& wall) {
  return {{"first_height", describe_quantiles(quantiles_of(wall.first_height))},
          {"tilt", describe_quantiles(quantiles_of(wall.tilt))},
          {"growth", describe_quantiles(wall.growth)}};
}

/// Adds how first heights have changed, if they can be compared.
void describe_change(json& block, std::span<const WallMeasures> before,
                     std::span<const WallMeasures> now, const Mesh& mesh) {
  const auto change = compare_first_heights(before, now);
  if (!change || change->worst_node < 0) return;
  const Vec3 p = place_of(mesh.coordinates, change->worst_node);
  block["first_height_ratio"] = describe_quantiles(change->ratio);
  block["first_height_changed"] = change->off;
  json place{p.x(), p.y()};
  if (mesh.coordinates.dimension() == 3) place.push_back(p.z());
  block["first_height_worst"] = {
      {"node", change->worst_node}, {"at", place}, {"ratio", change->worst_ratio}};
}

}  // namespace

void print_walls(std::ostream& out, const WallReport* before, const WallReport& now,
                 bool heights_asked_for) {
  if (now.size_ratio.count == 0) return;
  out << formatted("%-22s%11s%11s%11s%11s%11s\n", "Walls", "minimum", "5 %", "median", "95 %",
                   "maximum");
  const bool compares = before && !heights_asked_for;
  const auto change = compares ? compare_first_heights(before->walls, now.walls)
                               : std::optional<FirstHeightChange>();
  for (const Measure& measure : measures) {
    const std::string label = measure.label;
    if (before) print_row(out, label + ", before", before->*measure.of);
    print_row(out, label, now.*measure.of);
    if (change && measure.of == &WallReport::first_height)
      print_row(out, label + " / before", change->ratio);
  }
  if (now.walls.empty()) return;
  out << now.node_count() << " wall nodes";
  if (change && change->ratio.count > 0)
    out << formatted(", first height changed by more than %g %% at %.4g %% of them",
                     100 * FirstHeightChange::tolerance, 100 * change->off);
  out << '\n';
}

json describe_walls(const WallReport* before, const WallReport& now, const Mesh& mesh) {
  json block{{"nodes", now.node_count()}, {"now", describe_all(now)}};
  if (before) {
    block["before"] = describe_all(*before);
    describe_change(block, before->walls, now.walls, mesh);
  }
  block["units"] = {{"first_height", "units of the mesh"},
                    {"tilt", "degrees"},
                    {"growth", "1"},
                    {"size_ratio", "1"},
                    {"first_height_ratio", "1"},
                    {"first_height_changed", "1"}};
  json each = json::array();
  const bool paired = before && before->walls.size() == now.walls.size();
  for (std::size_t w = 0; w < now.walls.size(); ++w) {
    const WallMeasures& wall = now.walls[w];
    json& one = each.emplace_back();
    one["markers"] = wall.wall.markers;
    one["nodes"] = wall.wall.nodes.size();
    one["now"] = describe_one(wall);
    if (!paired) continue;
    one["before"] = describe_one(before->walls[w]);
    describe_change(one, {&before->walls[w], 1}, {&wall, 1}, mesh);
  }
  block["each"] = std::move(each);
  return block;
}

namespace {

void print_row(std::ostream& out, const char* name, const Statistics& s, double factor = 1) {
  out << formatted("%-22s%11.4g%11.4g%11.4g\n", name, factor * s.min, factor * s.avg,
                   factor * s.max);
}

/// Fraction of the requested thickness that a column reaches.
double share(const LayerColumn& column) {
  return column.asked > 0 ? column.thickness() / column.asked : 0;
}

std::vector<const LayerColumn*> thinnest_first(const LayerStack& stack) {
  std::vector<const LayerColumn*> cut;
  for (const LayerColumn& column : stack.columns)
    if (cut_short(column)) cut.push_back(&column);
  std::stable_sort(cut.begin(), cut.end(), [](const LayerColumn* a, const LayerColumn* b) {
    return share(*a) < share(*b);
  });
  return cut;
}

std::string_view end_sentence(LayerEnd end) {
  switch (end) {
    case LayerEnd::elements:
      return "no quadrilateral or pair of triangles goes on";
    case LayerEnd::boundary:
      return "the boundary is next";
    case LayerEnd::meeting:
      return "other layers are next";
    case LayerEnd::isotropic:
      return "elements become less than twice as long as high";
    case LayerEnd::growth:
      return "heights grow no further, or jump";
    case LayerEnd::clearance:
      return "another boundary is near";
    case LayerEnd::neighbours:
      return "the columns beside end";
    case LayerEnd::count:
      return "as many as were looked for";
    case LayerEnd::none:
      break;
  }
  return "";
}

/// Prints the detected layers and why they end: "Layers found: 224 columns of 18 to 42 rows; they
/// end where ...".
void print_found(std::ostream& out, const LayerStack& stack) {
  std::size_t found = 0, fewest = std::numeric_limits<std::size_t>::max(), most = 0;
  std::map<LayerEnd, std::size_t> ends;
  for (const LayerColumn& column : stack.columns) {
    if (column.end == LayerEnd::none || column.count() == 0) continue;
    ++found;
    ++ends[column.end];
    fewest = std::min(fewest, column.count());
    most = std::max(most, column.count());
  }
  if (found == 0) return;
  out << "Layers found: " << found << (found == 1 ? " column of " : " columns of ");
  if (fewest < most) out << fewest << " to ";
  out << most << (most == 1 ? " row" : " rows") << "; they end where ";
  std::vector<std::pair<LayerEnd, std::size_t>> sorted(ends.begin(), ends.end());
  std::ranges::stable_sort(sorted, std::greater<>(), [](const auto& end) { return end.second; });
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    out << (k == 0 ? "" : ", ") << end_sentence(sorted[k].first);
    if (sorted.size() > 1) out << " (" << sorted[k].second << ")";
  }
  out << '\n';
}

}  // namespace

void print_layers(std::ostream& out, const LayerStack& stack, const Coordinates& x, int limit) {
  const LayerMeasures m = measure_layers(stack, x);
  print_found(out, stack);
  print_row(out, "First height", m.first_height);
  print_row(out, "Total thickness", m.thickness);
  print_row(out, "Error of heights, %", m.spacing_error, 100);
  print_row(out, "Tilt, degrees", m.orthogonality);
  const auto cut = thinnest_first(stack);
  out << stack.columns.size() << (stack.columns.size() == 1 ? " column" : " columns")
      << " of layers, " << (cut.empty() ? "none" : std::to_string(cut.size())) << " cut short\n";
  const auto shown = std::min(cut.size(), static_cast<std::size_t>(std::max(limit, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    const LayerColumn& column = *cut[i];
    const std::string left = column.count() == 0
                                 ? std::string("no layers")
                                 : formatted("%.3g %% of the thickness", 100 * share(column));
    out << "  node " << column.wall_node << " at "
        << place_text(place_of(x, column.wall_node), x.dimension()) << ": " << left << " ("
        << limit_name(column.limit) << ")\n";
  }
  if (cut.size() > shown) out << "  and " << cut.size() - shown << " more\n";
}

namespace {

std::string quoted(const GivenPairs& given) {
  return '"' + given.first + '"' +
         (given.second == given.first ? "" : " and \"" + given.second + '"');
}

}  // namespace

void print_pairs(std::ostream& out, const GivenPeriodicity& periodicity, bool by_default,
                 const Mesh& mesh) {
  if (periodicity.pairs.empty()) return;
  out << "\nPeriodic in the file ("
      << (by_default ? "move together; --fixed NAME gives a pair up" : "--periodic-from-file")
      << ")\n";
  for (const GivenPairs& given : periodicity.pairs) {
    out << "  " << printable(quoted(given)) << ": ";
    if (!given.fault.empty()) {
      out << "cannot be used, " << printable(given.fault) << '\n';
      continue;
    }
    const PeriodicPairs pairs = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given);
    out << given.pairs.size() << (given.halo ? " halo nodes" : " pairs of nodes") << ", "
        << pairs.description << '\n';
  }
}

nlohmann::json describe_pairs(const GivenPeriodicity& periodicity, const Mesh& mesh) {
  nlohmann::json list = nlohmann::json::array();
  for (const GivenPairs& given : periodicity.pairs) {
    nlohmann::json entry{{"markers", {given.first, given.second}},
                         {"pairs", given.pairs.size()},
                         {"halo", given.halo}};
    if (given.fault.empty())
      entry["by"] = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).description;
    else
      entry["fault"] = given.fault;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace winslow::app
