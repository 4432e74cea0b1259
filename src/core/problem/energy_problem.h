#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_system.h"
#include "core/problem/smoothing_problem.h"
#include "core/types.h"

namespace winslow {

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
  /// The same problem with more nodes held: those of which `step` times the direction (#unknowns),
  /// a short way, leads from x over a place where what they slide on jumps or folds, so that the
  /// energy has no derivative there. Null if there are none.
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
  /// So much, and the same for all cells, that nothing is left of their determinants: the energy is
  /// a quadratic form, and one Newton step leads to its only minimum.
  virtual Regularisation full_regularisation(const Coordinates& x) const = 0;

  virtual double regularised_energy(const Coordinates& x,
                                    const Regularisation& regularisation) const = 0;
  /// As linearise(), with the part of the Hessian that is positive semidefinite by construction.
  virtual Linearisation linearise_regularised(const Coordinates& x,
                                              const Regularisation& regularisation,
                                              SparseMatrix& hessian,
                                              std::span<double> residual) const = 0;
};

}  // namespace winslow
