#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "core/mesh/coordinates.h"
#include "core/quality/validity.h"

namespace winslow {

/// How far a mesh is from solving a problem's equations.
struct ResidualNorms {
  double max = 0;  ///< largest scaled residual (dimensionless, see SmoothingProblem::residual)
  double rms = 0;  ///< root mean square of the same
};

/// What is solved when a mesh is smoothed: equations for those nodes that may move, the others
/// being where the boundary puts them. All that an outer solver, a path or a drag knows of a mesh.
///
/// A state x is the coordinates of all nodes. Which of its numbers are unknowns, or functions of
/// them (a node that slides along a curve has one unknown), is the problem's own affair: vectors
/// over the unknowns are #unknowns long, in an order that only it knows.
///
/// A problem never changes: other equations (another penalty, other targets) are another object, so
/// that what was worked out for one, a factorisation say, can tell by the object whether it holds.
class SmoothingProblem {
 public:
  virtual ~SmoothingProblem() = default;
  virtual std::string_view name() const = 0;

  virtual std::size_t unknowns() const = 0;
  /// The unknowns at x (#unknowns).
  virtual void values(const Coordinates& x, std::span<double> out) const = 0;
  /// Local length of the mesh that a change of each unknown compares with (#unknowns), in its unit.
  virtual void lengths(const Coordinates& x, std::span<double> out) const = 0;
  /// Changes the unknowns of x by step * direction (#unknowns). Returns the longest move of a node,
  /// in units of the mesh.
  virtual double advance(std::span<const double> direction, double step, Coordinates& x) const = 0;
  /// Velocity of each node that the unknowns move, where these change at the given rates
  /// (#unknowns). Those of the other nodes stay what they are in `out` (as large as x).
  virtual void velocities(const Coordinates& x, std::span<const double> rates,
                          Coordinates& out) const = 0;

  /// Largest t such that from + s (to - from) is valid for all s in [0, t); `most` if that is more.
  virtual double largest_valid_step(const Coordinates& from, const Coordinates& to,
                                    double most) const = 0;
  virtual Validity validity(const Coordinates& x) const = 0;

  /// Residual R into `out` (#unknowns; may be empty: norms only). The norms are of R scaled to the
  /// distance by which the equations of one node alone would move it, all others held, over the
  /// mean length of its edges.
  virtual ResidualNorms residual(const Coordinates& x, std::span<double> out) const = 0;
  /// Smallest ResidualNorms::max that double precision can show at x.
  virtual double residual_round_off(const Coordinates& x) const = 0;
  /// Change, to first order, of the right-hand side that the problem's linearisation at x has
  /// (#unknowns), when the prescribed nodes move by `displacement` (as large as x; what it holds
  /// for other nodes is ignored).
  virtual void boundary_response(const Coordinates& x, const Coordinates& displacement,
                                 std::span<double> out) const = 0;
};

}  // namespace winslow
