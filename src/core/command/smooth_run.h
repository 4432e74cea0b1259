#pragma once

#include "core/command/command.h"

namespace winslow {

/// Smooths the interior with the boundary held. x: start on entry, result on return.
SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& options, Coordinates& x,
                             const ExecuteOptions& run);

/// Moves the boundary as MotionOptions says and smooths after each step. x as above; on entry its
/// interior is where to start from.
SmoothResult smooth_motion(const MeshState& state, const Motion& motion, const MotionOptions& how,
                           const SmoothOptions& options, Coordinates& x, const ExecuteOptions& run);

}  // namespace winslow
