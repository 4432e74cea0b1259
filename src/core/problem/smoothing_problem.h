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

/// The equations that are solved when a mesh is smoothed. Their unknowns belong to the nodes that
/// may move; the boundary prescribes all others. Outer solvers, paths and drags access a mesh only
/// through this interface.
///
/// A state x holds the coordinates of all nodes. The problem alone knows how they depend on the
/// unknowns: a node that slides along a curve has one unknown, for example. Vectors over the
/// unknowns have #unknowns numbers, in an order that only the problem knows.
///
/// A problem is immutable. Other equations (another penalty, other targets) are another object. So
/// a factorisation, for example, stays valid as long as the object is the same.
class SmoothingProblem {
 public:
  virtual ~SmoothingProblem() = default;
  virtual std::string_view name() const = 0;

  virtual std::size_t unknowns() const = 0;
  /// The unknowns at x (#unknowns).
  virtual void values(const Coordinates& x, std::span<double> out) const = 0;
  /// Local length scale of the mesh for each unknown (#unknowns), in the unit of the unknown.
  virtual void lengths(const Coordinates& x, std::span<double> out) const = 0;
  /// Changes the unknowns of x by step * direction (#unknowns). Returns the longest move of a node,
  /// in units of the mesh.
  virtual double advance(std::span<const double> direction, double step, Coordinates& x) const = 0;
  /// Velocity of each node that the unknowns move, if they change at the given rates (#unknowns).
  /// The entries of the other nodes in `out` (as large as x) stay unchanged.
  virtual void velocities(const Coordinates& x, std::span<const double> rates,
                          Coordinates& out) const = 0;

  /// Largest t such that from + s (to - from) is valid for all s in [0, t); `most` if that is more.
  virtual double largest_valid_step(const Coordinates& from, const Coordinates& to,
                                    double most) const = 0;
  virtual Validity validity(const Coordinates& x) const = 0;

  /// Residual R into `out` (#unknowns; may be empty: norms only). The norms are of the scaled R:
  /// the distance by which a node's own equations would move it, with all other nodes held, divided
  /// by the mean length of its edges.
  virtual ResidualNorms residual(const Coordinates& x, std::span<double> out) const = 0;
  /// Smallest ResidualNorms::max that double precision can show at x.
  virtual double residual_round_off(const Coordinates& x) const = 0;
  /// First-order change of the right-hand side of the linearisation at x (#unknowns) when the
  /// prescribed nodes move by `displacement` (as large as x; entries of other nodes are ignored).
  virtual void boundary_response(const Coordinates& x, const Coordinates& displacement,
                                 std::span<double> out) const = 0;
};

/// For custom solvers: the energy of a problem and its derivatives.
///
///     winslow::SparseMatrix hessian;
///     std::vector<double> residual(problem.unknowns());
///     problem.linearise(x, winslow::Curvature::exact, hessian, residual);

/// Which second derivative of the energy a Newton system uses.
enum class Curvature {
  exact,     ///< the Hessian: quadratic convergence near a solution
  projected  ///< each cell's Hessian projected to positive semidefinite: a descent direction
};

/// What an assembly of the Newton system returns besides the system.
struct Linearisation {
  ResidualNorms norms;
  double energy;
};

/// What first-order methods need of an energy E, in vectors of the three components of each node
/// with unknowns (#rows by 3). The rows have an order of their own, in which neighbours in the mesh
/// lie close together. Where nodes slide, gradients have their components in the directions in
/// which the nodes may move.
class FirstOrderForm {
 public:
  virtual ~FirstOrderForm() = default;
  virtual Index rows() const = 0;
  /// Returns E, infinite where x is not valid. out: receives dE/dx, undefined where E is infinite.
  virtual double gradient(const Coordinates& x, std::span<double> out) const = 0;
  /// Whether no element is inverted wherever E is finite, if none was before.
  virtual bool is_barrier() const = 0;
  /// Lengths of the gradient of each row (#rows) at which its scaled residual is 1: see
  /// SmoothingProblem::residual().
  virtual void scales(const Coordinates& x, std::span<double> out) const = 0;
  virtual void positions(const Coordinates& x, std::span<double> out) const = 0;
  /// The rates (#unknowns) at which the nodes move by `vectors`, as far as they may.
  virtual void rates(const Coordinates& x, std::span<const double> vectors,
                     std::span<double> out) const = 0;
  /// A symmetric positive definite matrix, #rows by #rows, that resembles the Hessian in each
  /// component. Its pattern object is the same for all x.
  virtual void laplacian(const Coordinates& x, SparseMatrix& out) const = 0;
};

/// A problem whose solutions are minima of an energy E that is infinite where the mesh is invalid.
class EnergyProblem : public SmoothingProblem {
 public:
  /// Infinite where x is not valid.
  virtual double energy(const Coordinates& x) const = 0;
  /// R = -dE (#unknowns) and -dR as a symmetric matrix.
  virtual Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& hessian,
                                  std::span<double> residual) const = 0;
  /// Returns the same problem with more nodes held: those that a short step from x, `step` times
  /// the direction (#unknowns), moves across a jump or a fold of their curve or surface. The energy
  /// has no derivative there. Null if there are no such nodes.
  virtual std::shared_ptr<const EnergyProblem> holding_stuck_nodes(
      const Coordinates& /*x*/, std::span<const double> /*direction*/, double /*step*/) const {
    return nullptr;
  }
  /// Number of nodes held for this reason.
  virtual Index stuck_nodes() const { return 0; }
  /// The same energy for first-order methods; null if the problem has no such form.
  virtual std::shared_ptr<const FirstOrderForm> first_order() const { return nullptr; }
};

/// Replaces the barrier on meshes with inverted elements: the determinant D of a cell (twice the
/// area of a triangle) by chi = (D + sqrt(e^2 + D^2)) / 2, e = size[cell], which is positive for
/// every D (V. A. Garanzha et al., "Foldover-free maps in 50 lines of code", ACM TOG 40(4), 2021).
struct Regularisation {
  std::vector<double> size;  ///< #cells of the problem, in the unit of the determinants
  /// For a surface mesh: the normals (#elements) that give determinants their sign, constant during
  /// a line search.
  std::vector<Vec3> normals = {};
};

/// How soft the determinants of an untangling are. As both numbers go to zero, the energy of every
/// inverted cell goes to infinity, and that of valid cells to the energy without regularisation.
struct Softness {
  double of_size = 0.1;    ///< e as a share of a cell's size
  double of_inverted = 1;  ///< least e as a share of |D| where the determinant D is negative
};

/// An energy with a variant that is finite on every mesh, for untangling.
class UntanglingProblem : public EnergyProblem {
 public:
  /// Typical size of the cells around each cell at x (#cells): the scale for its determinant.
  virtual std::vector<double> cell_sizes(const Coordinates& x) const = 0;
  /// The regularisation of each cell. sizes: see cell_sizes().
  virtual Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                        const Softness& softness) const = 0;
  /// The same size for all cells, so large that the determinants no longer matter: the energy is a
  /// quadratic form, and one Newton step reaches its unique minimum.
  virtual Regularisation full_regularisation(const Coordinates& x) const = 0;

  virtual double regularised_energy(const Coordinates& x,
                                    const Regularisation& regularisation) const = 0;
  /// As linearise(), but only with the part of the Hessian that is positive semidefinite by
  /// construction.
  virtual Linearisation linearise_regularised(const Coordinates& x,
                                              const Regularisation& regularisation,
                                              SparseMatrix& hessian,
                                              std::span<double> residual) const = 0;
};

/// For custom solvers: the paper's fixed-point iteration, and Newton's method on equations.
///
///     winslow::SparseSystem system;
///     const winslow::Index negative_weights = equations.freeze(x, system);

/// Equations that can be linearised by freezing their coefficients: what a fixed-point iteration
/// needs.
class FixedPointProblem : public SmoothingProblem {
 public:
  /// Assembles the linear system A delta = R with frozen coefficients: delta is the step to the
  /// solution of the frozen equations. The right-hand sides hold one number per unknown, in the
  /// order of the unknowns. Returns the number of negative weights.
  virtual Index freeze(const Coordinates& x, SparseSystem& out) const = 0;
};

/// Equations without an energy, for Newton's method: a merit function defines descent.
class EquationProblem : public FixedPointProblem {
 public:
  /// Newton's system J delta = S R. The row scaling S is treated as constant. Returns the norms of
  /// R as residual() does.
  virtual ResidualNorms linearise(const Coordinates& x, SparseMatrix& jacobian,
                                  std::span<double> residual) const = 0;
  /// Weights of the residuals in the merit function at x. They are constant during a line search
  /// (only then is the Newton direction one of descent).
  virtual std::vector<double> merit_weights(const Coordinates& x) const = 0;
  /// Sum of the squares of the scaled residuals.
  virtual double merit(const Coordinates& x, std::span<const double> weights) const = 0;
};

/// The plain equations, and those with the negative weights of their rows set to zero: then every
/// row is a convex combination, which untangles. Both may be the same object.
template <typename Problem>
struct ClipVariants {
  std::shared_ptr<const Problem> plain, clipped;

  const std::shared_ptr<const Problem>& of(bool clip) const { return clip ? clipped : plain; }
};

}  // namespace winslow
