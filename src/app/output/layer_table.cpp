#include "app/output/layer_table.h"

#include <algorithm>
#include <ostream>
#include <string>
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

}  // namespace

void print_layers(std::ostream& out, const LayerStack& stack, const Coordinates& x, int limit) {
  const LayerMeasures m = measure_layers(stack, x);
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
