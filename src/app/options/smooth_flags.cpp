#include "app/options/smooth_flags.h"

#include <array>

#include "app/options/suggestion.h"
#include "core/error.h"
#include "core/formulation/formulation_names.h"
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

OuterMethod parse_outer(const std::string& text) {
  if (text == "newton") return OuterMethod::newton;
  return text == "picard" ? OuterMethod::picard : OuterMethod::automatic;
}

Untangle parse_untangle(const std::string& text) {
  if (text == "picard") return Untangle::picard;
  return text == "energy" ? Untangle::energy : Untangle::automatic;
}

TargetBlend parse_targets(const std::vector<std::string>& shares) {
  TargetBlend blend{0, 0, 0};
  for (const std::string& text : shares) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    double share = 1;
    if (equals != std::string::npos && !CLI::detail::lexical_cast(text.substr(equals + 1), share)) {
      throw UsageError("--targets " + text + ": expected NAME=SHARE with a number");
    }
    double* target = name == "element" ? &blend.element
                     : name == "vcv"   ? &blend.vcv
                     : name == "rest"  ? &blend.rest
                                       : nullptr;
    if (!target) {
      throw UsageError("--targets " + text + ": unknown shape '" + name +
                       "', expected element, vcv or rest");
    }
    *target = share;
  }
  return blend;
}

}  // namespace

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  const char* group = "Smoothing";
  app.add_option("--formulation", options.formulation, "Equations to solve")
      ->check(one_of(formulation_names()))
      ->option_text("NAME [" + options.formulation + "]")
      ->group(group);
  app.add_option_function<std::vector<std::string>>(
         "--targets",
         [&options](const std::vector<std::string>& shares) {
           options.targets = parse_targets(shares);
         },
         "Variational: shapes to strive for, alone or blended (element=0.7 vcv=0.3):\n"
         "  element: equilateral triangles, square corners\n"
         "  vcv: the virtual control volumes, with their angles and edge lengths\n"
         "  rest: the elements' own shapes in IN")
      ->option_text("NAME[=SHARE]... [element]")
      ->group(group);
  app.add_option("--exponent", options.penalty.exponent,
                 "Variational: power by which distortion beyond the knee is punished, >= 1")
      ->capture_default_str()
      ->group(group);
  app.add_option("--knee", options.penalty.knee,
                 "Variational: distortion from which the power counts, > 1; 0: the power alone")
      ->capture_default_str()
      ->group(group);
  app.add_option_function<std::string>(
         "--outer", [&options](const std::string& text) { options.outer = parse_outer(text); },
         "Outer iteration:\n"
         "  newton: Newton's method; boundary motions along the path of valid meshes\n"
         "  picard: the paper's, with frozen coefficients (pointwise only)\n"
         "  auto: newton; pointwise: picard where that does not end converged")
      ->check(one_of({"auto", "newton", "picard"}))
      ->option_text("auto|newton|picard [auto]")
      ->group(group);
  app.add_option_function<std::string>(
         "--untangle",
         [&options](const std::string& text) { options.untangle = parse_untangle(text); },
         "How inverted elements are untangled; auto: scrambles by energy first, moved boundaries "
         "by picard, then the other")
      ->check(one_of({"auto", "picard", "energy"}))
      ->option_text("auto|picard|energy [auto]")
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
  app.add_option(
         "--increments", options.increments,
         "Steps in which the boundary moves, each followed by smoothing; 0: follow the path, "
         "steps as long as they can be (pointwise with --outer picard: at once and, if that "
         "ends tangled, in more and more steps)")
      ->check(CLI::Range(0, 1000000))
      ->option_text("N [0]");
  app.add_flag_callback(
      "--direct", [&options] { options.increments = 1; },
      "Move the boundary at once, the interior left where it was, as in the paper; then untangle");
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
