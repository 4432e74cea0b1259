#include "gui/document/jobs/method.h"

namespace winslow::gui {

Method method_of(const SmoothOptions& smooth, const MotionOptions& motion) {
  if (!motion.smooth_after) return Method::custom;
  const bool fixed_point = smooth.formulation == "pointwise" && smooth.outer == OuterMethod::picard;
  if (fixed_point && motion.increments == 1) return Method::direct;
  if (!fixed_point && motion.increments == 0) return Method::path;
  return Method::custom;
}

void use_method(Method method, SmoothOptions& smooth, MotionOptions& motion) {
  if (method == Method::custom) return;
  const bool direct = method == Method::direct;
  smooth.formulation = direct ? "pointwise" : SmoothOptions{}.formulation;
  smooth.outer = direct ? OuterMethod::picard : OuterMethod::automatic;
  motion.increments = direct ? 1 : 0;
  motion.smooth_after = true;
  mend_linear_solver(smooth);
}

void mend_linear_solver(SmoothOptions& smooth) {
  if (smooth.formulation != "variational" && linear_solver_needs_symmetry(smooth.linear.solver))
    smooth.linear.solver = LinearOptions{}.solver;
}

}  // namespace winslow::gui
