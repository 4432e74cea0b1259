#pragma once

#include "core/linear/sparse_system.h"
#include "core/mesh/coordinates.h"
#include "core/quality/validity.h"
#include "core/types.h"

namespace winslow {

/// How far a mesh is from solving a problem's equations.
struct ResidualNorms {
  double max = 0;  ///< largest scaled residual (dimensionless, see SmoothingProblem::residual)
  double rms = 0;  ///< root mean square of the same
};

/// The equations that are solved when a mesh is smoothed. They are for the nodes that may move; all
/// others are where the boundary puts them. Outer solvers, paths and drags know a mesh only by
/// this.
///
/// A state x holds the coordinates of all nodes. The problem alone knows how they depend on the
/// unknowns: a node that slides along a curve has one unknown, for example. Vectors over the
/// unknowns have #unknowns numbers, in an order that only the problem knows.
///
/// A problem never changes. Other equations (another penalty, other targets) are another object. So
/// a factorisation, for example, is still good if it was made for the same object.
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

/// For solvers of one's own: an energy and its derivatives, of any problem.
///
///     winslow::SparseMatrix hessian;
///     std::vector<double> residual(problem.unknowns());
///     problem.linearise(x, winslow::Curvature::exact, hessian, residual);

/// Which second derivative of the energy a Newton system is made of.
enum class Curvature {
  exact,     ///< the Hessian: quadratic convergence near a solution
  projected  ///< each cell's Hessian projected to positive semidefinite: always downhill
};

/// What an assembly of the Newton system finds out besides.
struct Linearisation {
  ResidualNorms norms;
  double energy;
};

/// A problem whose solutions are minima of an energy E that is infinite where the mesh is invalid.
class EnergyProblem : public SmoothingProblem {
 public:
  /// Infinite where x is not valid.
  virtual double energy(const Coordinates& x) const = 0;
  /// R = -dE (#unknowns) and -dR as a symmetric matrix.
  virtual Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& hessian,
                                  std::span<double> residual) const = 0;
  /// The same problem with more nodes held: those that a short step from x, `step` times the
  /// direction (#unknowns), moves across a jump or a fold of what they slide on. The energy has no
  /// derivative there. Null if there are no such nodes.
  virtual std::shared_ptr<const EnergyProblem> holding_stuck_nodes(
      const Coordinates& /*x*/, std::span<const double> /*direction*/, double /*step*/) const {
    return nullptr;
  }
  /// How many nodes are held so.
  virtual Index stuck_nodes() const { return 0; }
};

/// Replaces the barrier on meshes with inverted elements: the determinant D of a cell (twice the
/// area of a triangle) by chi = (D + sqrt(e^2 + D^2)) / 2, e = size[cell], which is positive for
/// every D (V. A. Garanzha et al., "Foldover-free maps in 50 lines of code", ACM TOG 40(4), 2021).
struct Regularisation {
  std::vector<double> size;  ///< #cells of the problem, in the unit of their determinants
  /// Of a surface mesh: the normals (#elements) against which cells are seen, held while a step is
  /// searched for.
  std::vector<Vec3> normals = {};
};

/// An energy with a version that is finite on every mesh: what untangling needs.
class UntanglingProblem : public EnergyProblem {
 public:
  /// How large the cells around each cell are at x (#cells): what its determinant is to be
  /// compared with.
  virtual std::vector<double> cell_sizes(const Coordinates& x) const = 0;
  /// `softness` times the size of each cell, and no less than the magnitude of its determinant
  /// where that is negative. sizes: see cell_sizes().
  virtual Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                        double softness) const = 0;
  /// The same for all cells, and so large that their determinants no longer matter: the energy is a
  /// quadratic form, and one Newton step leads to its only minimum.
  virtual Regularisation full_regularisation(const Coordinates& x) const = 0;

  virtual double regularised_energy(const Coordinates& x,
                                    const Regularisation& regularisation) const = 0;
  /// As linearise(), with the part of the Hessian that is positive semidefinite by construction.
  virtual Linearisation linearise_regularised(const Coordinates& x,
                                              const Regularisation& regularisation,
                                              SparseMatrix& hessian,
                                              std::span<double> residual) const = 0;
};

/// For solvers of one's own: the fixed-point iteration of the paper, and Newton's of equations.
///
///     winslow::SparseSystem system;
///     const winslow::Index negative_weights = equations.freeze(x, system);

/// Equations that can be linearised by freezing their coefficients: what a fixed-point iteration
/// needs.
class FixedPointProblem : public SmoothingProblem {
 public:
  /// Linear system A delta = R of the fixed-point iteration with frozen coefficients: the step to
  /// the solution of the equations linearised by freezing. The numbers of its right-hand sides are
  /// the unknowns, in their order. Returns the number of negative weights met.
  virtual Index freeze(const Coordinates& x, SparseSystem& out) const = 0;
};

/// Equations without an energy, for Newton's method: what lies downhill is told by a merit
/// function.
class EquationProblem : public FixedPointProblem {
 public:
  /// Newton's system J delta = S R, S a scaling of the rows that counts as constant. Returns the
  /// norms of R as residual() does.
  virtual ResidualNorms linearise(const Coordinates& x, SparseMatrix& jacobian,
                                  std::span<double> residual) const = 0;
  /// What the merit function weighs residuals by, as it is at x; held while a step is searched for
  /// (only then is the Newton direction one of descent).
  virtual std::vector<double> merit_weights(const Coordinates& x) const = 0;
  /// Sum of the squares of the scaled residuals.
  virtual double merit(const Coordinates& x, std::span<const double> weights) const = 0;
};

/// Equations as they are, and with the negative weights of their rows set to zero: then every row
/// is a convex combination, which untangles. May be one and the same.
template <typename Problem>
struct ClipVariants {
  std::shared_ptr<const Problem> plain, clipped;

  const std::shared_ptr<const Problem>& of(bool clip) const { return clip ? clipped : plain; }
};

}  // namespace winslow
