#include "app/options/smooth_flags.h"

#include "app/options/option_flags.h"
#include "core/command/option_tables.h"

namespace winslow::app {

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  add_option_flags(app, option_table(options), "Smoothing");
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
