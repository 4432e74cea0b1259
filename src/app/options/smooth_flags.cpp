#include "app/options/smooth_flags.h"

#include <array>

#include "app/options/suggestion.h"
#include "core/formulation/formulation.h"
#include "core/linear/linear_solver.h"

namespace winslow::app {
namespace {

std::string linear_help() {
  std::string help = "How the linear systems are solved:";
  for (const std::string& name : linear_solver_names()) {
    help += "\n  " + name + ": " + std::string(linear_solver_summary(name));
  }
  return help;
}

Clip parse_clip(const std::string& text) {
  if (text == "on") return Clip::on;
  return text == "off" ? Clip::off : Clip::automatic;
}

}  // namespace

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  const char* group = "Smoothing";
  app.add_option("--formulation", options.formulation, "Equations to solve")
      ->check(one_of(formulation_names()))
      ->option_text("NAME [" + options.formulation + "]")
      ->group(group);
  app.add_option("--linear", options.linear.solver, linear_help())
      ->check(one_of(linear_solver_names()))
      ->option_text("NAME [" + options.linear.solver + "]")
      ->group(group);
  app.add_option("--damping", options.damping,
                 "Share of each linear solution that is taken, (0, 1]")
      ->capture_default_str()
      ->group(group);
  app.add_flag_callback(
         "--fixed-damping", [&options] { options.adapt_damping = false; },
         "Keep the damping where the iteration makes no progress, instead of halving it")
      ->group(group);
  app.add_option("--acceleration", options.acceleration,
                 "Earlier iterates that Anderson acceleration combines; 0: the plain iteration")
      ->capture_default_str()
      ->group(group);
  app.add_option_function<std::string>(
         "--clip", [&options](const std::string& text) { options.clip = parse_clip(text); },
         "Set negative weights to zero; auto: while the mesh is tangled")
      ->check(one_of({"on", "off", "auto"}))
      ->option_text("on|off|auto [auto]")
      ->group(group);
  app.add_option("--max-iterations", options.max_iterations, "Limit of outer iterations")
      ->capture_default_str()
      ->group(group);
  app.add_option("--tolerance", options.tolerance,
                 "Largest scaled residual at which the mesh counts as converged")
      ->capture_default_str()
      ->group(group);
  app.add_option("--threads", options.threads,
                 "Threads; 0 for all cores (the result does not depend on it)")
      ->check(CLI::Range(0, 4096))
      ->option_text("N [0]")
      ->group(group);
}

void add_motion_flags(CLI::App& app, MotionOptions& options) {
  app.add_option("--increments", options.increments,
                 "Steps in which the boundary moves, each followed by smoothing; 1: at once; "
                 "0: at once and, if that ends tangled, in more and more steps")
      ->check(CLI::Range(0, 1000000))
      ->option_text("N [0]");
  app.add_flag_callback(
      "--no-smooth", [&options] { options.smooth_after = false; }, "Move the boundary only");
}

void add_marker_flag(CLI::App& app, std::vector<std::string>& markers) {
  app.add_option("--marker", markers, "Marker that moves; several move together")
      ->required()
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("NAME");
}

CLI::Option* add_vector_flag(CLI::App& app, const std::string& name, Vec2& value,
                             const std::string& description) {
  return app
      .add_option_function<std::array<double, 2>>(
          name, [&value](const std::array<double, 2>& v) { value = Vec2(v[0], v[1]); }, description)
      ->type_name("X Y");
}

}  // namespace winslow::app
