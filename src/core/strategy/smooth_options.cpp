#include "core/strategy/smooth_options.h"

#include <cmath>

#include <algorithm>

#include "core/error.h"
#include "core/formulation/formulation_names.h"

namespace winslow {

namespace {

void require_known(const std::vector<std::string>& names, const std::string& name,
                   const std::string& what) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  std::string known;
  for (const auto& n : names) known += (known.empty() ? "" : ", ") + n;
  throw UsageError("unknown " + what + " '" + name + "', expected one of: " + known);
}

void require(bool good, const std::string& message) {
  if (!good) throw UsageError(message);
}

}  // namespace

void validate(const SmoothOptions& options) {
  require_known(formulation_names(), options.formulation, "formulation");
  require_known(linear_solver_names(), options.linear.solver, "linear solver");
  const bool variational = options.formulation == "variational";
  require(!(variational && options.outer == OuterMethod::picard),
          "the variational form has no fixed-point iteration: choose the outer method newton, or "
          "the formulation pointwise");
  require(
      variational || !linear_solver_needs_symmetry(options.linear.solver),
      "the linear solver " + options.linear.solver +
          " takes symmetric systems only: choose automatic, direct or gmres, or the formulation "
          "variational");
  require(options.penalty.exponent >= 1 && options.penalty.exponent <= 64,
          "the exponent is not between 1 and 64");
  require(options.penalty.knee == 0 ||
              (options.penalty.knee > 1 && std::isfinite(options.penalty.knee)),
          "the knee is neither 0 nor a number greater than 1");
  const TargetBlend& t = options.targets;
  require(t.element >= 0 && t.vcv >= 0 && t.rest >= 0 && t.element + t.vcv + t.rest > 0 &&
              std::isfinite(t.element + t.vcv + t.rest),
          "the shares of the target shapes must not be negative, nor all zero");
  require(
      options.damping > 0 && options.damping <= 1,
      "the damping is " + std::to_string(options.damping) + ", expected more than 0, at most 1");
  require(
      options.acceleration >= 0 && options.acceleration <= 100,
      "the acceleration depth is " + std::to_string(options.acceleration) + ", expected 0 to 100");
  require(options.max_iterations >= 0, "the number of outer iterations is negative");
  require(options.tolerance > 0 && options.tolerance < 1, "the tolerance is not between 0 and 1");
  require(options.threads >= 0, "the number of threads is negative");
  require(options.linear.tolerance > 0 && options.linear.tolerance < 1,
          "the linear tolerance is not between 0 and 1");
  require(options.linear.max_iterations > 0, "the number of linear iterations is not positive");
  require(options.linear.restart > 0, "the GMRES restart is not positive");
}

}  // namespace winslow
