#include "app/output/openfoam_section.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "app/output/terminal.h"
#include "core/error.h"

namespace winslow::app {
namespace {

using nlohmann::json;

std::string title_of(const CheckedMeasure& row) {
  std::string title(row.label);
  if (row.unit == "degrees") title += ", degrees";
  return title;
}

void print_row(std::ostream& out, const CheckedMeasure& row) {
  // Six significant digits, as checkMesh prints.
  out << formatted("%-27s", title_of(row).c_str())
      << formatted("%13.6g%13.6g%13.6g", row.values.min, row.values.avg, row.values.max)
      << formatted("%14s",
                   formatted(row.larger_is_better ? ">= %.3g" : "<= %.3g", row.limit).c_str())
      << "  ";
  if (row.beyond == 0)
    out << "all " << row.of << '\n';
  else
    out << "but " << row.beyond << " of " << row.count << ' ' << row.of << '\n';
}

void print_verdict(std::ostream& out, const char* who, const std::vector<std::string>& failures) {
  out << who << (failures.empty() ? " finds no fault of the geometry\n" : " fails for ");
  if (failures.empty()) return;
  for (std::size_t i = 0; i < failures.size(); ++i) out << (i == 0 ? "" : ", ") << failures[i];
  out << '\n';
}

}  // namespace

void print_openfoam_measures(std::ostream& out, const OpenFoamMeasures& measures) {
  out << formatted("%-27s%13s%13s%13s%14s\n", "OpenFOAM's measures", "minimum", "average",
                   "maximum", "limit");
  for (const CheckedMeasure& row : measures.rows)
    if (row.count > 0) print_row(out, row);
  print_verdict(out, "checkMesh", measures.failures());
  if (const auto further = measures.further_failures(); !further.empty())
    print_verdict(out, "checkMesh -allGeometry also", further);
}

json describe_openfoam_measures(const OpenFoamMeasures& measures) {
  json block;
  for (const CheckedMeasure& row : measures.rows)
    block[std::string(row.name)] = {{"min", row.values.min},
                                    {"avg", row.values.avg},
                                    {"max", row.values.max},
                                    {"limit", row.limit},
                                    {"count", row.count},
                                    {"beyond", row.beyond},
                                    {"unit", row.unit.empty() ? "1" : row.unit}};
  block["boundary_openness"] = measures.boundary_openness;
  block["total_volume"] = measures.total_volume;
  block["orthogonality_errors"] = measures.orthogonality_errors;
  block["pyramid_errors"] = measures.pyramid_errors;
  block["poor_divisions"] = measures.poor_divisions;
  block["concave_cells"] = measures.concave_cells;
  block["failures"] = measures.failures();
  block["further_failures"] = measures.further_failures();
  return block;
}

}  // namespace winslow::app
