#pragma once

#include <functional>

#include "core/strategy/run_recorder.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// The paper's way with adjusted VCVs (AIAA 2009-1362, section V): from the mesh x that a run has
/// led to they are worked out anew, and the mesh is solved for again; as often as
/// SmoothOptions::vcv_updates says, or until no VCV changes any more. VCVs of a mesh that came
/// tangled say little: they are worked out anew in any case. Does nothing for VCVs of other kinds,
/// and for equations that are not over VCVs.
///
/// solve: the run, from a mesh with the boundary where it is to be. given: the mesh that the VCVs
/// are of. Ends with the last solution if there is none for the next VCVs.
void update_vcvs(const Coordinates& given, SmoothingWorkspace& workspace, RunRecorder& recorder,
                 const std::function<void(Coordinates&)>& solve, Coordinates& x);

}  // namespace winslow
