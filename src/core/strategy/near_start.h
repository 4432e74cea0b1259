#pragma once

#include "core/motion/motion.h"
#include "core/strategy/newton_run.h"

namespace winslow {

/// Carries out a motion from a mesh that a run was given to start from (RunOptions::start), which
/// may be near the end of the motion.
///
/// First it predicts the result, and converges from there: from a combination of known meshes
/// (NearStart::earlier) with nearly the boundary of the result, else from the known mesh with the
/// nearest boundary, to first order in the way that the boundary has from there. If the prediction
/// is not valid or too far from the result, it follows the path from the start, or starts in one
/// step where the start is not valid. motion: of the mesh as given. x: receives the result. Returns
/// false, and leaves x as it is, if the start is of no use.
bool start_near(const MeshState& state, const Motion& motion, const RunOptions& run,
                SmoothingWorkspace& workspace, NewtonRun& steps, Coordinates& x);

}  // namespace winslow
