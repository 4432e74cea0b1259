#pragma once

#include <optional>
#include <span>

#include "core/mesh/mesh.h"
#include "core/quality/surface_distance.h"

namespace winslow {

/// How far a surface mesh is from another one of the same shape, and the volume that it encloses.
/// Surfaces are those of the elements: plane triangles, quadrilaterals cut along their shorter
/// diagonal.
struct SurfaceChange {
  /// Largest distance, in units of the mesh, from places of one surface to the other: its nodes,
  /// the middles of its edges and of its elements. The larger one is the Hausdorff distance of the
  /// two, as far as these places tell.
  double from_before = 0, from_after = 0;
  double extent = 0;  ///< diagonal of the box around the mesh before
  /// Enclosed volume; none of a surface that is not closed.
  std::optional<double> volume_before, volume_after;

  double hausdorff() const { return from_before > from_after ? from_before : from_after; }
};

/// threads: 0 for all cores; no result depends on it. Throws UsageError unless both are surface
/// meshes.
SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads = 0);

/// The same of a surface whose distances are known already. after_to_before: what
/// element_distances() says of the mesh after.
SurfaceChange compare_surfaces(const Mesh& before, const SurfaceDistance& to_before,
                               const Mesh& after, std::span<const double> after_to_before,
                               int threads = 0);

/// The volume that a closed surface mesh encloses, positive if its elements face outwards.
double enclosed_volume(const Mesh& mesh);

}  // namespace winslow
