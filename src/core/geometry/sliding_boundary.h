#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/sliding_geometry.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// A stretch of a marker's boundary without features, as it was recognised.
struct SlidingPart {
  std::string marker;
  std::string description;   ///< "straight line", "circle of radius 10", "plane"
  std::vector<Index> nodes;  ///< those that slide on it
};

/// What the nodes of some markers slide on, from the mesh as given, and which of them do.
///
/// In the plane a marker is cut at its features: where it turns by more than the feature angle,
/// ends or meets the rest of the boundary. The nodes there stay; the others slide on the curve
/// through their stretch (curve_through()).
///
/// In space a node slides if all boundary faces around it are of one marker and lie in one plane.
/// Those on the edge in which two planes of the markers meet stay, too, or slide along it. Markers
/// that are not made up of planes are refused.
struct SlidingBoundary {
  std::vector<SlidingPart> parts;
  std::shared_ptr<const SlidingGeometry> geometry;

  /// markers: names. feature_angle: in degrees, 0 to 180, in the plane. features: in space nodes
  /// slide along straight edges. Throws UsageError for markers that the
  /// mesh does not have, those of which no node can slide, and in space curved ones.
  static SlidingBoundary find(const Topology& topology, const Coordinates& x,
                              std::span<const std::string> markers, double feature_angle,
                              bool features = false);
};

}  // namespace winslow
