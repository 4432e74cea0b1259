#pragma once

#include "core/motion/motion.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Smooths the interior with the boundary held. x: start on entry, result on return.
SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const RunOptions& run);

/// Moves the boundary as MotionOptions says and smooths after each step. x as above; on entry its
/// interior is the start.
SmoothResult smooth_motion(const MeshState& state, const Motion& motion, const MotionOptions& how,
                           const SmoothOptions& options, Coordinates& x, const RunOptions& run);

/// The state's coordinates, with the interior of options.start if there is one. Throws UsageError
/// for a start with another number of nodes.
Coordinates starting_point(const MeshState& state, const RunOptions& options);

}  // namespace winslow
