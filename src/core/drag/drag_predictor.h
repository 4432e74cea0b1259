#pragma once

#include "core/motion/rigid_motion.h"
#include "core/outer/outer_solver.h"

namespace winslow {

/// How a smoothed mesh answers, to first order, when some of its boundary moves rigidly: the
/// tangent fields of a translation along each axis, and of a rotation (in the plane) or one about
/// each axis (in space), from one factorisation and three or six solves. After that every position
/// under the mouse is a linear combination of them.
///
/// In the plane, with U_x, U_y, U_r the fields of a node and a rotation by a about the pivot,
///
///   x(a, t) = x + t_x U_x + t_y U_y + sin a U_r + (1 - cos a) P U_r,   P = [[0, -1], [1, 0]];
///
/// in space, about the unit axis n, with U_r = n_x U_rx + n_y U_ry + n_z U_rz,
///
///   x(a, t) = x + t_x U_x + t_y U_y + t_z U_z + sin a U_r + (1 - cos a) n x U_r
///
/// (Rodrigues): exact on the body itself, where U_r = P (x - pivot) or n x (x - pivot), so that the
/// nodes around it turn with it; of first order elsewhere. Immutable once made.
class DragPredictor {
 public:
  /// solver: at its solution x. nodes: the prescribed nodes that move together. shares: of a
  /// translation that each of them takes, if they are no rigid body; there is no rotation then.
  /// Throws NumericError where the equations at x have no regular derivative.
  DragPredictor(SteadySolver& solver, const Coordinates& x, std::vector<Index> nodes,
                std::vector<double> shares = {}, int threads = 0);

  /// The mesh after `motion`, seen from the mesh that the predictor was made at. The boundary is
  /// exactly where the motion takes it; whether the mesh is valid is the caller's to check.
  void evaluate(const RigidMotion& motion, Coordinates& out) const;

  const Coordinates& base() const { return base_; }

 private:
  template <int D>
  void prepare(SteadySolver& solver, const Points<D>& points);
  template <int D, typename Velocity>
  Coordinates solve_for(SteadySolver& solver, const Velocity& velocity) const;
  template <int D>
  void evaluate(const RigidMotion& motion, const Points<D>& base, Coordinates& out) const;

  Coordinates base_;
  std::vector<Index> nodes_;
  std::vector<double> shares_;             // empty: a rigid body
  std::vector<Coordinates> translations_;  // tangent field of each direction
  std::vector<Coordinates> rotations_;     // U_r, or U_rx, U_ry, U_rz; empty: not a rigid body
  Vec3 pivot_{0, 0, 0};
  int threads_;
};

}  // namespace winslow
