#pragma once

#include "core/motion/rigid_motion.h"
#include "core/outer/outer_solver.h"

namespace winslow {

/// Predicts, to first order, a smoothed mesh after a rigid motion of a part of its boundary. It has
/// the tangent fields of a translation along each axis and of a rotation (in space one about each
/// axis), from one factorisation and three or six solves. Each prediction is then a linear
/// combination of these fields.
///
/// In the plane, with U_x, U_y, U_r the fields of a node and a rotation by a about the pivot,
///
///   x(a, t) = x + t_x U_x + t_y U_y + sin a U_r + (1 - cos a) P U_r,   P = [[0, -1], [1, 0]];
///
/// in space, about the unit axis n, with U_r = n_x U_rx + n_y U_ry + n_z U_rz,
///
///   x(a, t) = x + t_x U_x + t_y U_y + t_z U_z + sin a U_r + (1 - cos a) n x U_r
///
/// (Rodrigues). This is exact on the body itself, where U_r = P (x - pivot) or n x (x - pivot), so
/// that the nodes around it rotate with it, and of first order elsewhere. Immutable.
class DragPredictor {
 public:
  /// solver: at its solution x. nodes: the prescribed nodes that move together. shares: of the
  /// translation, for each node, if the nodes are not a rigid body; rotations are then not
  /// available. Throws NumericError if the derivative of the equations at x is singular.
  DragPredictor(SteadySolver& solver, const Coordinates& x, std::vector<Index> nodes,
                std::vector<double> shares = {}, int threads = 0);

  /// Writes the mesh after `motion`, relative to the mesh for which the predictor was made. The
  /// motion of the boundary is exact; the caller must check the validity of the mesh.
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
