#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/linear/factorisation.h"
#include "core/mesh/mesh.h"

/// A reference implementation of the usual mesh deformation of flow solvers, to measure winslow
/// against: the mesh as a linear elastic solid, after SU2 (Common/src/grid_movement/
/// CVolumetricMovement.cpp; T. D. Economon et al., AIAA Journal 54(3), 2016).
namespace winslow::bench {

/// What Young's modulus of an element is the inverse of; a common factor would change nothing.
enum class Modulus {
  wall_distance,  ///< mean distance of its nodes from the nearest node of the walls that move
  volume,         ///< its area
  constant        ///< 1: all are alike
};

struct ElasticityOptions {
  Modulus modulus = Modulus::wall_distance;  ///< SU2's default
  double poisson_ratio = 0.3;                ///< SU2's DEFORM_POISSONS_RATIO
  int increments = 1;                        ///< SU2's DEFORM_NONLINEAR_ITER
};

/// Stiffness of an element in plane strain (2 #corners squared, row-major; unknowns x0, y0, x1,
/// ...): integral of B^T D B, one point for triangles, 2 by 2 Gauss points of the isoparametric map
/// for quadrilaterals. corners: 3 or 4, counter-clockwise.
std::vector<double> element_stiffness(std::span<const Vec2> corners, double modulus,
                                      double poisson_ratio);

/// Strain energy of the same element with these displacements of its corners: integral of
/// (lambda tr(eps)^2 + 2 mu eps : eps) / 2, at the same points.
double strain_energy(std::span<const Vec2> corners, std::span<const Vec2> displacements,
                     double modulus, double poisson_ratio);

/// Solves the interior of a mesh with all boundary nodes at given displacements. The ordering of
/// the factorisation is kept from one solution to the next.
class ElasticSolid {
 public:
  /// walls: nodes from which distances count (Modulus::wall_distance only).
  ElasticSolid(std::shared_ptr<const Topology> topology, std::vector<Index> walls,
               const ElasticityOptions& options);

  /// Moves the interior of x (#nodes by 2) along with its boundary nodes, which go to where
  /// `boundary` has them; stiffness is that of the mesh x. Throws NotPositiveDefinite where
  /// elements are inverted so badly that the matrix has no Cholesky factor.
  void deform(Coordinates& x, const Coordinates& boundary);

 private:
  void make_pattern();
  std::vector<double> moduli(const Coordinates& x) const;
  void assemble(const Coordinates& x, const Coordinates& boundary);

  std::shared_ptr<const Topology> topology_;
  std::vector<Index> walls_;
  ElasticityOptions options_;
  std::vector<Index> unknown_;  // #nodes: place among the interior nodes; -1 on the boundary
  SparseMatrix matrix_;
  std::vector<double> rhs_;
  std::unique_ptr<Factorisation> factors_ = make_cholesky();
};

/// Where the boundary nodes are at a share (0 to 1) of the motion.
using BoundaryMotion = std::function<void(double share, Coordinates& x)>;

/// Deforms in options.increments equal steps of the motion, the stiffness that of the mesh after
/// the step before.
void deform_in_increments(ElasticSolid& solid, const BoundaryMotion& motion, int increments,
                          Coordinates& x);

}  // namespace winslow::bench
