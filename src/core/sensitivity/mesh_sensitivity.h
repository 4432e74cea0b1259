#pragma once

#include "core/command/command.h"

/// Gradients for shape optimisation: how much a function of all nodes of a moved mesh changes with
/// the nodes of its boundary.
///
///     const winslow::CommandResult moved = winslow::execute(move, state);
///     const winslow::MeshSensitivity sensitivity(state, move, moved);
///     const winslow::Coordinates on_boundary = sensitivity.transpose(derivative_by_nodes);
namespace winslow {

/// The derivative dX/dB of the nodes X of a moved mesh by those of its boundary B, at the result of
/// a motion: products with it (forward) and with its transpose, one linear solve each.
///
/// The mesh of a motion minimises an energy E(q, B) over its unknowns q (VariationalWinslow), so
/// dE/dq = 0 at every B, and with the Hessian H of E over all nodes, the velocities V = dX/dq of
/// the nodes by the unknowns, and M = d(dE/dx)/dB through the targets (WallStretch),
///
///   dX/dB = I_B - V (V^T H V + K)^-1 V^T (H I_B + M),
///
/// where K is the part of the curvature of what nodes slide on (M. B. Giles and N. A. Pierce, Flow
/// Turbul. Combust. 65, 2000, for the transposed use). Away from a minimum there is no such
/// derivative: the equations are first solved to 1e-10.
///
/// WHAT IS FROZEN at the mesh: the penalty (its knee may have been raised), the weights of
/// deliberately stretched elements where these are clipped, the elements over a wall, the nodes
/// that are held at folds of a surface, and the corrections of the heights of held layers. frozen()
/// has the numbers. What changes with the boundary is differentiated: the places of nodes that
/// slide, images across periodic sides, rows of nodes between ends that the motion takes, the
/// targets over stretched walls, and those VCVs of held layers that were corrected.
///
/// Immutable; calls at once from several threads are allowed.
class MeshSensitivity {
 public:
  /// state: the mesh before the motion. motion: a MoveCommand or DeformCommand. moved: what it
  /// gave. options: threads and cancelling (monitor). Throws UsageError for other commands, options
  /// that minimise no energy, surface meshes, and a boundary that lies elsewhere in `moved` than
  /// the motion takes it; NumericError if no minimum is found near `moved`; and what execute()
  /// throws.
  MeshSensitivity(const MeshState& state, const ResolvedCommand& motion, const CommandResult& moved,
                  const RunOptions& options = {});
  /// The same for the coordinates of the result alone (#nodes). If the state holds layers, the
  /// motion is carried out from there to find the corrections of the heights.
  MeshSensitivity(const MeshState& state, const ResolvedCommand& motion, const Coordinates& moved,
                  const RunOptions& options = {});
  ~MeshSensitivity();
  MeshSensitivity(MeshSensitivity&&) noexcept;
  MeshSensitivity& operator=(MeshSensitivity&&) noexcept;

  /// The mesh at which the derivative is: `moved`, solved to 1e-10.
  const Coordinates& mesh() const;
  /// How far a node of mesh() is from its place in `moved` at most, as a share of the mean length
  /// of its edges. More than about .01: the motion was not converged, or had other options.
  double distance() const;
  /// The nodes without unknowns that are taken along by no others, ascending: B. All other nodes
  /// depend on these.
  const std::vector<Index>& boundary() const;

  /// dX/dB dB: the velocities of all nodes (#nodes by 2 or 3) if those of boundary() move at the
  /// velocities `boundary` (as large; others are not read). Throws NumericError if the linear
  /// solver does not converge.
  Coordinates forward(const Coordinates& boundary) const;
  /// (dX/dB)^T J: the derivative of a function by the nodes of boundary(), from its derivative
  /// `function` by all nodes (#nodes by 2 or 3). Zero at all other nodes. Throws as forward() does.
  Coordinates transpose(const Coordinates& function) const;

  /// What the derivative takes as constant although the mesh may depend on it.
  struct Frozen {
    double knee = 0;         ///< of the penalty
    double knee_raised = 1;  ///< by this factor
    Index stuck_nodes = 0;   ///< held at folds of what they slide on
    Index heights = 0;       ///< of held layers, whose corrections are constant
  };
  Frozen frozen() const;
  /// A description of the linear solver.
  std::string solver() const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

/// Derivatives by the numbers of a motion, one product for all of them:
///
///     const auto on_boundary = sensitivity.transpose(derivative_by_nodes);
///     const auto parameter = winslow::MotionParameter::rotate;
///     const auto turn = winslow::parameter_velocities(mesh, body, parameter);
///     const double by_degree = winslow::scalar_product(on_boundary, turn);
///
/// Each body of a motion has velocities of its own. Those by the numbers of a SineDeformation:
/// sine_velocities().

/// A number of a RigidMotion.
enum class MotionParameter { rotate, translate_x, translate_y, translate_z };

/// The velocities of the nodes of a body (#nodes by 2 or 3; zero at all others) per degree of its
/// angle, or per unit of its shift. moved: the mesh after the motion. body: with a pivot, see
/// with_pivot(). Throws UsageError for an unknown marker, a rotation without a pivot or in space
/// without an axis, and translate_z in the plane.
Coordinates parameter_velocities(const Mesh& moved, const MovingBody& body,
                                 MotionParameter parameter);

/// The sum of the products of all components.
double scalar_product(const Coordinates& a, const Coordinates& b);

}  // namespace winslow
