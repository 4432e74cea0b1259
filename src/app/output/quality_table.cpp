#include "app/output/quality_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

#include "app/output/formatted.h"
#include "core/mesh/place_text.h"

namespace winslow::app {
namespace {

constexpr int bar_width = 50;

/// Three decimals, unless the number would lose its meaning.
std::string number(double value) {
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

void print_quality_table(std::ostream& out, const Mesh& mesh, const QualityReport& quality) {
  out << formatted("%-22s%11s%11s%11s\n", "", "minimum", "average", "maximum");
  for (const Metric m : reported_metrics(quality.cell_dimension)) {
    const Statistics& s = quality.of(m).statistics;
    out << formatted("%-22s",
                     std::string(metric_info(m, quality.cell_dimension).field.label).c_str())
        << number(s.min) << number(s.avg) << number(s.max) << '\n';
  }
  out << counted(mesh.topology->node_count(), "node", "nodes") << ", "
      << counted(mesh.topology->element_count(), "element", "elements") << ", " << quality.inverted
      << " inverted\n";
  if (quality.all_on_boundary > 0) {
    out << counted(quality.all_on_boundary, "element has", "elements have")
        << " all nodes on the boundary and cannot move: not measured above";
    if (quality.all_on_boundary_inverted > 0)
      out << ", " << quality.all_on_boundary_inverted << " of them inverted";
    out << '\n';
  }
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
    print_list(out, wall_field_info(field), quality.worst_by(field), 2);
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

}  // namespace winslow::app
