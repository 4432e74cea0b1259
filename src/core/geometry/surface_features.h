#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/chains.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

/// What a node of a surface is.
enum class SurfaceNode : std::uint8_t {
  none,    ///< not of the surface
  inside,  ///< no feature comes to it
  line,    ///< a feature line runs through it
  corner   ///< feature lines end or meet there, or turn; or the tip of a cone
};

/// The features of a surface: edges at which it turns by more than an angle, its borders, those
/// between markers, and those of more than two faces.
struct SurfaceFeatures {
  std::vector<SurfaceNode> nodes;  ///< #nodes of the mesh
  std::vector<Chain> lines;        ///< along feature edges, from corner to corner or closed
  std::vector<Index> region;  ///< #faces: faces of one region hang together, no feature between
  Index regions = 0;
  /// Corners by the angle alone, ascending: one feature line turns there; tips.
  std::vector<Index> bends, tips;
};

/// angle: in degrees. x: of all nodes of the mesh. smooth: nodes that are no corners although a
/// feature line turns there, or the surface has a tip.
SurfaceFeatures find_features(const Coordinates& x, std::span<const SurfaceFace> faces,
                              double angle, std::span<const Index> smooth = {});

}  // namespace winslow
