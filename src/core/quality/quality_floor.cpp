#include "core/quality/quality_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace winslow {

namespace {

std::string broken(const FieldInfo& info, double limit) {
  char text[80];
  std::snprintf(text, sizeof text, " would be %s than %.6g",
                info.larger_is_better ? "less" : "more", limit);
  return std::string(info.label) + text;
}

/// Written so that a value that is no number is within no limit.
bool within(const FieldInfo& info, double value, double limit) {
  return info.larger_is_better ? value >= limit : value <= limit;
}

/// An element that came no better than this. Of what moves as a whole the last digits change.
bool came_so(const Mesh& mesh, const Coordinates& given, Index e, Metric metric, double value) {
  constexpr double round_off = 1e-6;
  const FieldInfo& info = metric_info(metric, 3).field;
  const double before = element_value({mesh.topology, given}, e, metric);
  const double slack = round_off * std::abs(before);
  return before == value || within(info, value, before + (info.larger_is_better ? -slack : slack));
}

std::vector<Metric> all_limited() {
  std::vector<Metric> all = reported_metrics(2);
  for (const Metric metric : reported_metrics(3))
    if (std::ranges::find(all, metric) == all.end()) all.push_back(metric);
  return all;
}

}  // namespace

const std::vector<Metric>& limited_metrics() {
  static const std::vector<Metric> all = all_limited();
  return all;
}

bool QualityFloor::given() const {
  return std::ranges::any_of(limits, [](const auto& limit) { return limit.has_value(); });
}

void QualityFloor::set(Metric metric, double limit) {
  const auto& limited = limited_metrics();
  const auto found = std::ranges::find(limited, metric);
  if (found == limited.end())
    throw UsageError("no limit can be set to the " + std::string(metric_name(metric)) +
                     ": it is not reported");
  limits[static_cast<std::size_t>(found - limited.begin())] = limit;
}

void QualityFloor::require_dimension(int cell_dimension) const {
  const auto& reported = reported_metrics(cell_dimension);
  for (std::size_t m = 0; m < limits.size(); ++m) {
    const Metric metric = limited_metrics()[m];
    if (!limits[m] || std::ranges::find(reported, metric) != reported.end()) continue;
    std::string known;
    for (const Metric other : reported)
      known += (known.empty() ? "" : ", ") + std::string(metric_name(other));
    throw UsageError("a limit of the quality (min-quality): found " +
                     std::string(metric_name(metric)) + ", which " +
                     (cell_dimension == 2 ? "plane" : "volume") +
                     " elements do not have, expected one of: " + known);
  }
}

std::string QualityFloor::fault(const Mesh& mesh, const Coordinates& given) const {
  const Topology& topology = *mesh.topology;
  const int dimension = topology.cell_dimension();
  for (std::size_t m = 0; m < limits.size(); ++m) {
    if (!limits[m]) continue;
    const Metric metric = limited_metrics()[m];
    const FieldInfo& info = metric_info(metric, dimension).field;
    const double limit = *limits[m];
    const auto values = element_values(mesh, metric);
    for (Index e = 0; e < topology.element_count(); ++e) {
      const double value = values[static_cast<std::size_t>(e)];
      if (within(info, value, limit)) continue;
      const bool apart = dimension == 3 && all_on_boundary(topology, e);
      if (!apart || !came_so(mesh, given, e, metric, value)) return broken(info, limit);
    }
  }
  return {};
}

}  // namespace winslow
