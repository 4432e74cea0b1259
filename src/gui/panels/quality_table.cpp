#include "gui/panels/quality_table.h"

#include <cmath>

#include "gui/base/text.h"

namespace winslow::gui {

namespace {

QualityRow row_of(const char* name, const double* before, double now, bool larger_is_better) {
  QualityRow row;
  row.name = name;
  row.now = table_number(now);
  row.before = before ? table_number(*before) : "-";
  // A change that is not seen in the numbers beside it would only puzzle.
  if (!before || row.before == row.now || !std::isfinite(*before) || !std::isfinite(now))
    return row;
  const double change = now - *before;
  row.change = (change > 0 ? "+" : "\xE2\x88\x92") + table_number(std::abs(change));
  row.verdict = (change > 0) == larger_is_better ? 1 : -1;
  return row;
}

QualityRow inverted_row(const QualityReport* before, const QualityReport& now) {
  QualityRow row;
  row.name = "Inverted";
  row.tip = "Elements with a corner whose area is not positive. A solver cannot use such a mesh.";
  row.now = grouped(now.inverted);
  row.before = before ? grouped(before->inverted) : "-";
  if (!before || before->inverted == now.inverted) return row;
  const Index change = now.inverted - before->inverted;
  row.change = (change > 0 ? "+" : "\xE2\x88\x92") + grouped(std::abs(change));
  row.verdict = change < 0 ? 1 : -1;
  return row;
}

}  // namespace

std::vector<QualityRow> quality_table(const QualityReport* before, const QualityReport& now) {
  std::vector<QualityRow> rows;
  for (const Metric metric : reported_metrics()) {
    const FieldInfo& info = metric_info(metric).field;
    rows.push_back({std::string(info.label), std::string(info.help), true, {}, {}, {}, 0});
    const Statistics& n = now.of(metric).statistics;
    const Statistics* b = before ? &before->of(metric).statistics : nullptr;
    rows.push_back(row_of("min", b ? &b->min : nullptr, n.min, info.larger_is_better));
    rows.push_back(row_of("avg", b ? &b->avg : nullptr, n.avg, info.larger_is_better));
    rows.push_back(row_of("max", b ? &b->max : nullptr, n.max, info.larger_is_better));
  }
  rows.push_back(inverted_row(before, now));
  return rows;
}

}  // namespace winslow::gui
