#pragma once

#include "core/motion/motion.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Smooths the sliding boundary of a volume mesh as a surface mesh, for elements of the boundary
/// that are as good as they can be by themselves, and then moves the boundary there through valid
/// meshes, the interior smoothed (options.slide.surface_first). x: start on entry, result on
/// return. Throws UsageError for meshes that are no volume meshes, and without sliding markers.
SmoothResult smooth_surface_first(const MeshState& state, const SmoothOptions& options,
                                  Coordinates& x, const RunOptions& run);

}  // namespace winslow
