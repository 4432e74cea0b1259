#pragma once

#include <vector>

#include "core/motion/motion.h"
#include "core/outer/steady_solver.h"

namespace winslow {

/// How a smoothed mesh answers, to first order, when some of its boundary moves rigidly: the
/// tangent fields of a translation along x, one along y and a rotation, from one factorisation and
/// three solves. After that every position under the mouse is a linear combination of them.
///
/// With U_x, U_y, U_r the fields of a node and a rotation by a about the pivot,
///
///   x(a, t) = x + t_x U_x + t_y U_y + sin a U_r + (1 - cos a) P U_r,   P = [[0, -1], [1, 0]]:
///
/// exact on the body itself, where U_r = P (x - pivot), so that the nodes around it turn with it;
/// of first order elsewhere. Immutable once made.
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
  template <typename Velocity>
  Coordinates solve_for(SteadySolver& solver, const Velocity& velocity) const;

  Coordinates base_;
  std::vector<Index> nodes_;
  std::vector<double> shares_;              // empty: a rigid body
  std::vector<Coordinates> translations_;   // tangent field of each direction
  Coordinates rotation_, turned_rotation_;  // U_r and P U_r; empty: not a rigid body
  Vec2 pivot_{0, 0};
  int threads_;
};

}  // namespace winslow
