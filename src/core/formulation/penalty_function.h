#pragma once

#include <cmath>

#include "core/formulation/simplex_kernel.h"

namespace winslow::distortion {

/// psi(f) = f + (f / knee)^p, or f^p without a knee: its first two derivatives.
struct PenaltySlopes {
  double first, second;
};

class PenaltyFunction {
 public:
  PenaltyFunction(double exponent, double knee) {
    const double whole = std::round(exponent);
    const bool is_small_natural = whole == exponent && whole >= 2 && whole <= 32;
    constants_ = {exponent, knee > 0 ? 1.0 : 0.0, knee > 0 ? std::pow(knee, -exponent) : 1.0,
                  is_small_natural ? static_cast<int>(whole) - 2 : -1};
  }

  const PenaltyConstants& constants() const { return constants_; }
  PenaltySlopes slopes(double f) const {
    const double p = constants_.exponent;
    const double power = constants_.scale * std::pow(f, p - 2);
    return {constants_.linear + p * power * f, p * (p - 1) * power};
  }

 private:
  PenaltyConstants constants_;
};

}  // namespace winslow::distortion
