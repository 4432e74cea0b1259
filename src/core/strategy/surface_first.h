#pragma once

#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

/// Smooths a volume mesh after its own surface, so that the interior does not affect the faces:
///
///     winslow::SmoothCommand smooth;
///     smooth.smooth.slide.markers = {"hull"};
///     smooth.smooth.slide.surface_first = true;
///     state = winslow::execute(smooth, state).state;
namespace winslow {

/// Smooths the sliding boundary of a volume mesh first, as a surface mesh, so that the interior
/// does not affect its faces. Then moves the boundary there through valid meshes and smooths the
/// interior (options.slide.surface_first). x: start on entry, result on return. Throws UsageError
/// for other meshes than volume meshes, and without sliding markers.
SmoothResult smooth_surface_first(const MeshState& state, const SmoothOptions& options,
                                  Coordinates& x, const RunOptions& run);

}  // namespace winslow
