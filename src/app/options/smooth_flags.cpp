#include "app/options/smooth_flags.h"

#include "app/options/option_flags.h"
#include "core/command/option_tables.h"
#include "core/error.h"

namespace winslow::app {
namespace {

std::string limited_names() {
  std::string names;
  for (const Metric metric : limited_metrics())
    names += (names.empty() ? "" : ", ") + std::string(metric_name(metric));
  return names;
}

/// Of elements of either dimension: which the mesh has is not known yet.
Metric metric_named(const std::string& name) {
  for (const int dimension : {2, 3}) {
    for (const Metric metric : all_metrics(dimension))
      if (metric_name(metric) == name) return metric;
  }
  throw UsageError("--min-quality: unknown metric '" + name +
                   "', expected one of: " + limited_names());
}

/// "normalized_jacobian=0.2"
void set_limit(QualityFloor& floor, const std::string& word) {
  const std::size_t equals = word.find('=');
  double limit = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(word.substr(equals + 1), limit))
    throw UsageError("--min-quality " + word + ": expected METRIC=VALUE with a number");
  floor.set(metric_named(word.substr(0, equals)), limit);
}

}  // namespace

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  add_option_flags(app, option_table(options), "Smoothing");
}

void add_min_quality_flag(CLI::App& app, QualityFloor& floor) {
  app.add_option_function<std::vector<std::string>>(
         "--min-quality",
         [&floor](const std::vector<std::string>& words) {
           for (const std::string& word : words) set_limit(floor, word);
         },
         "End the motion before any element is worse than this; several limits hold together: " +
             limited_names())
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("METRIC=VALUE")
      ->group("Motion");
}

void add_direct_flag(CLI::App& app, MotionOptions& options) {
  app.add_flag_callback(
         "--direct", [&options] { options.increments = 1; },
         "Move the boundary at once, the interior left where it was, as in the paper; then "
         "untangle")
      ->group("Motion");
}

void add_marker_flag(CLI::App& app, std::vector<std::string>& markers) {
  app.add_option("--marker", markers, "Marker that moves; several move together")
      ->required()
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("NAME");
}

}  // namespace winslow::app
