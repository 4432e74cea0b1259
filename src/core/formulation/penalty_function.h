#pragma once

#include <cmath>

#include "core/formulation/simplex_kernel.h"

namespace winslow {

/// Shape of psi.
struct PenaltyOptions {
  double exponent = 8;  ///< p >= 1
  double knee = 1.78;   ///< distortion f from which the power counts, > 1; 0: psi(f) = f^p
  double bound = 0;     ///< if positive psi(f) = f / (1 - f / bound), infinite from the bound on

  bool operator==(const PenaltyOptions&) const = default;
};

namespace distortion {

/// psi(f) = f + (f / knee)^p, or f^p without a knee, or f / (1 - f / bound): its first two
/// derivatives.
struct PenaltySlopes {
  double first, second;
};

class PenaltyFunction {
 public:
  explicit PenaltyFunction(const PenaltyOptions& options) {
    const auto [exponent, knee, bound] = options;
    const double whole = std::round(exponent);
    const bool is_small_natural = whole == exponent && whole >= 2 && whole <= 32;
    constants_ = {exponent, knee > 0 ? 1.0 : 0.0, knee > 0 ? std::pow(knee, -exponent) : 1.0,
                  is_small_natural ? static_cast<int>(whole) - 2 : -1, bound > 0 ? 1 / bound : 0.0};
  }

  const PenaltyConstants& constants() const { return constants_; }
  PenaltySlopes slopes(double f) const {
    if (constants_.inverse_bound > 0) {
      const double growth = 1 / (1 - constants_.inverse_bound * f);
      return {growth * growth, 2 * constants_.inverse_bound * growth * growth * growth};
    }
    const double p = constants_.exponent;
    const double power = constants_.scale * std::pow(f, p - 2);
    return {constants_.linear + p * power * f, p * (p - 1) * power};
  }

 private:
  PenaltyConstants constants_;
};

}  // namespace distortion

}  // namespace winslow
