#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/linear/factorisation.h"
#include "core/linear/linear_solver.h"
#include "core/mesh/mesh.h"

/// A reference implementation of the usual mesh deformation of flow solvers, to measure winslow
/// against: the mesh as a linear elastic solid, after SU2 (Common/src/grid_movement/
/// CVolumetricMovement.cpp; T. D. Economon et al., AIAA Journal 54(3), 2016). In the plane (D = 2)
/// and, of tetrahedra, in space (D = 3).
namespace winslow::bench {

/// What Young's modulus of an element is the inverse of; a common factor would change nothing.
enum class Modulus {
  wall_distance,  ///< mean distance of its nodes from the nearest node of the walls that move
  volume,         ///< its area or volume
  constant        ///< 1: all are alike
};

struct ElasticityOptions {
  Modulus modulus = Modulus::wall_distance;  ///< SU2's default
  double poisson_ratio = 0.3;                ///< SU2's DEFORM_POISSONS_RATIO
  int increments = 1;                        ///< SU2's DEFORM_NONLINEAR_ITER
  double tolerance = 1e-6;  ///< of the linear systems in space, relative; they are direct else
  int threads = 0;          ///< in space; 0: all
};

/// Stiffness of an element (D #corners squared, row-major; unknowns x0, y0, x1, ...): integral of
/// B^T D B, one point for triangles in plane strain and for tetrahedra, 2 by 2 Gauss points of the
/// isoparametric map for quadrilaterals. corners: of a triangle or quadrilateral,
/// counter-clockwise; of a tetrahedron of positive volume.
std::vector<double> element_stiffness(std::span<const Vec2> corners, double modulus,
                                      double poisson_ratio);
std::vector<double> element_stiffness(std::span<const Vec3> corners, double modulus,
                                      double poisson_ratio);

/// Strain energy of the same element with these displacements of its corners: integral of
/// (lambda tr(eps)^2 + 2 mu eps : eps) / 2, at the same points.
double strain_energy(std::span<const Vec2> corners, std::span<const Vec2> displacements,
                     double modulus, double poisson_ratio);
double strain_energy(std::span<const Vec3> corners, std::span<const Vec3> displacements,
                     double modulus, double poisson_ratio);

/// Solves the interior of a mesh with all boundary nodes at given displacements: by Cholesky
/// factors in the plane, whose ordering is kept from one solution to the next, by conjugate
/// gradients with the multigrid of core/linear in space.
template <int D>
class ElasticSolid {
 public:
  /// walls: nodes from which distances count (Modulus::wall_distance only). Throws UsageError for
  /// elements of space that are no tetrahedra.
  ElasticSolid(std::shared_ptr<const Topology> topology, std::vector<Index> walls,
               const ElasticityOptions& options);

  /// Moves the interior of x along with its boundary nodes, which go to where `boundary` has them;
  /// stiffness is that of the mesh x. Throws NotPositiveDefinite where elements are inverted so
  /// badly that the matrix is not positive definite.
  void deform(Coordinates& x, const Coordinates& boundary);

  /// The stiffness of the mesh x, between its interior nodes.
  const SparseMatrix& stiffness(const Coordinates& x) {
    assemble(x, x);
    return matrix_;
  }

  /// Of the iterative solver, in all.
  int linear_iterations() const { return linear_iterations_; }

 private:
  void make_pattern();
  std::vector<double> moduli(const Coordinates& x) const;
  void assemble(const Coordinates& x, const Coordinates& boundary);
  void add_element(Index e, std::size_t entry, const std::vector<double>& stiffness,
                   const Coordinates& x, const Coordinates& boundary);
  void solve(std::vector<double>& u);

  std::shared_ptr<const Topology> topology_;
  std::vector<Index> walls_;
  ElasticityOptions options_;
  std::vector<Index> unknown_;  // #nodes: place among the interior nodes; -1 on the boundary
  SparseMatrix matrix_;
  std::vector<Index> entries_;  // of matrix_: row by row of each element's blocks; -1: none
  std::vector<double> rhs_;
  std::unique_ptr<Factorisation> factors_;  // in the plane
  std::unique_ptr<LinearSolver> solver_;    // in space
  int linear_iterations_ = 0;
};

extern template class ElasticSolid<2>;
extern template class ElasticSolid<3>;

/// Where the boundary nodes are at a share (0 to 1) of the motion.
using BoundaryMotion = std::function<void(double share, Coordinates& x)>;

/// Deforms in options.increments equal steps of the motion, the stiffness that of the mesh after
/// the step before.
template <int D>
void deform_in_increments(ElasticSolid<D>& solid, const BoundaryMotion& motion, int increments,
                          Coordinates& x) {
  for (int k = 1; k <= increments; ++k) {
    Coordinates boundary = x;
    motion(static_cast<double>(k) / increments, boundary);
    solid.deform(x, boundary);
  }
}

}  // namespace winslow::bench
