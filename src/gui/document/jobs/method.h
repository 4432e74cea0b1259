#pragma once

#include "core/command/command.h"

namespace winslow::gui {

/// How a motion is solved, as the first choice that a user makes.
enum class Method {
  path,    ///< follow the boundary's motion through valid meshes
  direct,  ///< the paper's: the boundary at once, then its outer iteration on the tangled mesh
  custom   ///< a combination of options that is neither
};

/// Iterations a second at which the direct method is shown unless the user says otherwise.
constexpr double default_pace = 10;

Method method_of(const SmoothOptions& smooth, const MotionOptions& motion);

/// Sets what makes up a method and leaves the rest; `custom` changes nothing.
void use_method(Method method, SmoothOptions& smooth, MotionOptions& motion);

/// Puts a linear solver that the formulation does not take back to automatic.
void mend_linear_solver(SmoothOptions& smooth);

}  // namespace winslow::gui
