#pragma once

#include "core/motion/motion.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

class SmoothingWorkspace;
class VariationalForm;

/// Smooths the interior with the boundary held. x: start on entry, result on return.
SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const RunOptions& run);

/// Moves the boundary as MotionOptions says and smooths after each step. x as above; on entry its
/// interior is the start.
SmoothResult smooth_motion(const MeshState& state, const Motion& motion, const MotionOptions& how,
                           const SmoothOptions& options, Coordinates& x, const RunOptions& run);

/// The equations of a motion with the boundary at its end, and their solution.
struct MotionEquations {
  std::shared_ptr<SmoothingWorkspace> workspace;  ///< prepared; the form refers to it
  std::shared_ptr<const VariationalForm> form;    ///< with the penalty at the solution
  std::shared_ptr<const NodeClasses> classes;
  std::vector<TakenNode> taken;       ///< by the motion, at the solution
  std::vector<double> layer_factors;  ///< RunOptions::layer_factors; empty: none
  std::shared_ptr<const Coordinates> reference;
  Coordinates solution;
  SmoothResult result;
};

/// Solves the equations that smooth_motion() leaves the mesh with, from a mesh near their solution.
/// start: that mesh; its nodes that the motion does not take need not be at their places. Throws
/// UsageError for the pointwise form, the fixed point and raise_worst, which minimise no energy.
MotionEquations solve_at_end(const MeshState& state, const Motion& motion,
                             const SmoothOptions& options, const Coordinates& start,
                             const RunOptions& run);

/// The state's coordinates, with the interior of options.start if there is one. Throws UsageError
/// for a start with another number of nodes.
Coordinates starting_point(const MeshState& state, const RunOptions& options);

}  // namespace winslow
