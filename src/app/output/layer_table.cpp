#include "app/output/layer_table.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/output/formatted.h"
#include "core/layers/layer_measures.h"
#include "core/mesh/place_text.h"

namespace winslow::app {
namespace {

void print_row(std::ostream& out, const char* name, const Statistics& s, double factor = 1) {
  out << formatted("%-22s%11.4g%11.4g%11.4g\n", name, factor * s.min, factor * s.avg,
                   factor * s.max);
}

/// Share that is left of the thickness that was asked for.
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

/// What was found, and why it ends: "Layers found: 224 columns of 18 to 42 rows; they end where
/// ...".
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
    out << "  node " << column.wall_node << " at " << place_text(x.xy(column.wall_node)) << ": "
        << left << " (" << limit_name(column.limit) << ")\n";
  }
  if (cut.size() > shown) out << "  and " << cut.size() - shown << " more\n";
}

}  // namespace winslow::app
