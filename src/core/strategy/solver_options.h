#pragma once

#include "core/outer/energy_newton.h"
#include "core/outer/equation_options.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/sphere/star_builder.h"

namespace winslow {

/// What the options of a smoothing run mean to its solvers.
inline NewtonOptions newton_options(const SmoothOptions& options) {
  return {options.tolerance, options.linear.tolerance};
}
inline EquationOptions equation_options(const SmoothOptions& options) {
  return {options.clip, options.tolerance, options.damping, options.adapt_damping,
          options.acceleration};
}

VolumeVcvOptions volume_vcv_options(const SmoothOptions& options);

}  // namespace winslow
