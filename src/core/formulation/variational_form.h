#pragma once

#include <cmath>

#include "core/formulation/simplex_kernel.h"
#include "core/problem/node_unknowns.h"
#include "core/problem/smoothing_problem.h"

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

class TargetPath;

/// The variational form of either dimension, as runs know it.
class VariationalForm : public NodeProblem<UntanglingProblem> {
 public:
  const PenaltyOptions& penalty() const { return penalty_; }
  /// The same with another penalty. What depends on the connectivity is shared; so are the targets.
  virtual std::shared_ptr<const VariationalForm> with_penalty(
      const PenaltyOptions& penalty) const = 0;
  /// The same with targets for which only angles count at right-angled corners of quadrilaterals
  /// and hexahedra, and at those of prisms all but the ratio of height to triangle: their edges are
  /// as long as those at x.
  ///
  /// Of a right-angled corner f is then 1 / sin in the plane, and in space the -2/3rd power of the
  /// scaled Jacobian, at x itself; and no less than that anywhere else (the mean of squares and
  /// that of logarithms). So what lowers the largest f from x on raises the smallest of these.
  virtual std::shared_ptr<const VariationalForm> with_corner_lengths(
      const Coordinates& x) const = 0;
  /// Largest f of any cell; infinite if one is inverted.
  virtual double worst_distortion(const Coordinates& x) const = 0;
  /// Targets on the way from the shapes of a valid mesh to the form's own.
  virtual std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const = 0;
  /// CellTargets::stretched.
  virtual std::optional<double> stretched() const = 0;

 protected:
  VariationalForm(NodeUnknowns nodes, const PenaltyOptions& penalty)
      : NodeProblem(std::move(nodes)), penalty_(penalty) {}
  void set_penalty(const PenaltyOptions& penalty) { penalty_ = penalty; }

 private:
  PenaltyOptions penalty_;
};

/// Targets on the way from the shapes that the cells of a mesh have to those that are wanted: on
/// the geodesic between their metrics. With its own shapes for targets a mesh is the exact minimum
/// of the energy, whatever it looks like. So a path of minima begins at any valid mesh, and nothing
/// has to be relaxed before it.
class TargetPath {
 public:
  virtual ~TargetPath() = default;
  /// share: 0 (the shapes of the mesh) to 1 (as wanted).
  virtual std::shared_ptr<const VariationalForm> at_share(double share) const = 0;
};

}  // namespace winslow
