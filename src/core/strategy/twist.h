#pragma once

#include "core/motion/motion.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// Carries a whole mesh along with its bodies, as a start for its smoothing:
///
///     if (const auto twist = Twist::find(classes, x, motion, threads)) twist->carry(0, 1, x);
///
/// With rigid bodies each node follows a screw motion. Its twist is the sum of those of the bodies
/// times the weights of the node. For each body, u solves the p-Laplace equation on the mesh
/// (LaplaceEquation) with u = 1 on the body, and u = 0 on other bodies and on all fixed nodes. If
/// nothing is fixed, the weights add up to 1.
///
/// In space p = 3, and u is the weight. It spreads the shear: the twist of an ellipsoid in a tight
/// box by 90 degrees inverts no element where p = 2 inverts 66. In the plane p = 2. With
/// S(u) = u^2 (3 - 2 u) and U the sum of u over the bodies, the weight of a body is there
/// S(U) S(u) over the sum of S(u). Near bodies the gradient of these weights vanishes, so layers
/// there move as rigid bodies.
///
/// Where a body deforms, as by a table of displacements, all nodes move in straight lines. Their
/// displacements solve the p-Laplace equation, p = 3, with those of the bodies on the bodies, and 0
/// on fixed nodes.
class Twist {
 public:
  /// x: a valid mesh before the motion. None in the plane unless all bodies are rigid: there the
  /// path is as fast. classes outlives the result.
  static std::optional<Twist> find(const NodeClasses& classes, const Coordinates& x,
                                   const Motion& motion, int threads);

  /// Moves the nodes that have unknowns from their places at one fraction of the motion to those at
  /// another. Sliding nodes move along their tangents, and off what they slide on if that is
  /// curved. All other nodes stay. No body may turn by more than 180 degrees at once.
  void carry(double from, double to, Coordinates& x) const;

  /// The largest angle by which a rigid body turns during the whole motion, in degrees.
  double largest_turn() const;

 private:
  struct Body {
    RigidMotion motion;           // resolved
    std::vector<double> weights;  // #nodes
  };

  Twist(const NodeClasses& classes, const Vec3& origin) : classes_(classes), origin_(origin) {}

  bool stays(Index node) const;
  void find_weights(const Coordinates& x, const std::vector<const Motion*>& bodies, int threads);
  void find_displacements(const Coordinates& x, const Motion& motion, int threads);

  const NodeClasses& classes_;
  Vec3 origin_;                      // to which the twists refer
  std::vector<Body> bodies_;         // if all are rigid
  std::vector<Vec3> displacements_;  // else: #nodes, of the whole motion
};

}  // namespace winslow
