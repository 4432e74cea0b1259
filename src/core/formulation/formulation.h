#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/mesh/coordinates.h"

namespace winslow {

/// How far a mesh is from solving a formulation's equations.
struct ResidualNorms {
  double max = 0;  ///< largest scaled nodal residual (dimensionless, see Formulation::residual)
  double rms = 0;  ///< root mean square of the same
};

/// The equations that are solved over the VCVs. All vectors over the free nodes are #free by
/// dimension, row after row, in the order of Topology::free_nodes().
class Formulation {
 public:
  virtual ~Formulation() = default;
  virtual std::string_view name() const = 0;

  /// Nodal residuals R into `out` (may be empty: norms only). The norms are of R scaled at each
  /// node to the distance by which the equation of that node alone would move it, its neighbours
  /// held, over the mean length of its edges. clip: with negative weights set to zero, where a
  /// formulation has weights.
  virtual ResidualNorms residual(const Coordinates& x, bool clip, std::span<double> out) const = 0;
};

/// Equations that can be linearised by freezing their coefficients: what a fixed-point iteration
/// needs.
class FixedPointFormulation : public Formulation {
 public:
  /// Linear system A delta = R of the fixed-point iteration with frozen coefficients: the step to
  /// the solution of the equations linearised by freezing. clip as in residual(). Returns the
  /// number of negative weights met.
  virtual Index freeze(const Coordinates& x, bool clip, SparseSystem& out) const = 0;
};

/// "variational", "pointwise".
std::vector<std::string> formulation_names();

}  // namespace winslow
