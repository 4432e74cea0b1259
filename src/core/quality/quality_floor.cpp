#include "core/quality/quality_floor.h"

#include <algorithm>
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

}  // namespace

bool QualityFloor::given() const {
  return std::ranges::any_of(limits, [](const auto& limit) { return limit.has_value(); });
}

void QualityFloor::set(Metric metric, double limit) {
  const auto& reported = reported_metrics();
  const auto found = std::ranges::find(reported, metric);
  if (found == reported.end())
    throw UsageError("no limit can be set to the " + std::string(metric_name(metric)) +
                     ": it is not reported");
  limits[static_cast<std::size_t>(found - reported.begin())] = limit;
}

std::string QualityFloor::fault(const std::shared_ptr<const Topology>& topology,
                                const Coordinates& x) const {
  const Mesh mesh{topology, x};
  for (std::size_t m = 0; m < limits.size(); ++m) {
    if (!limits[m]) continue;
    const FieldInfo& info = metric_info(reported_metrics()[m], topology->cell_dimension()).field;
    const double limit = *limits[m];
    const auto values = element_values(mesh, reported_metrics()[m]);
    // Written so that a value that is no number breaks the limit.
    const bool kept = std::ranges::all_of(values, [&](double value) {
      return info.larger_is_better ? value >= limit : value <= limit;
    });
    if (!kept) return broken(info, limit);
  }
  return {};
}

}  // namespace winslow
