#pragma once

#include <map>

#include "core/geometry/curve.h"
#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/triangulation.h"
#include "core/mesh/surface_faces.h"
#include "core/types.h"

namespace winslow {

/// Nodes one after the other along edges; a closed chain does not repeat its first.
struct Chain {
  std::vector<Index> nodes;
  bool closed = false;

  /// From a node that it does not pass round to the same.
  bool loop() const { return !closed && nodes.size() > 1 && nodes.front() == nodes.back(); }
};

/// The other ends of the edges at each node.
using EdgeEnds = std::map<Index, std::vector<Index>>;

/// Every edge in one chain. Chains run on through the nodes that `passes` says, all of which have
/// two edges, and end at the others; those that meet none of these are closed.
std::vector<Chain> find_chains(const EdgeEnds& ends, const std::function<bool(Index)>& passes);

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

/// The curves and surfaces through the nodes of a surface that was cut at its features.

/// Curves along feature lines (curve_through()).
struct FeatureCurves {
  /// One per line; null for lines of fewer than two nodes, and loops of fewer than four.
  std::vector<std::shared_ptr<const SpaceCurve>> curves;
  /// #nodes: of the curves, where lines run through a node; elsewhere zero.
  std::vector<Vec3> tangents;
};
FeatureCurves curves_along(const SpacePoints& x, const SurfaceFeatures& features);

/// The faces of each region (#regions).
std::vector<std::vector<Index>> faces_of_regions(const SurfaceFeatures& features);

/// The nodes of some faces, ascending.
std::vector<Index> nodes_of_faces(std::span<const SurfaceFace> faces,
                                  std::span<const Index> chosen);

/// Some faces as triangles; quadrilaterals are cut along their shorter diagonal. Points are in the
/// order of `nodes`, those of the faces in ascending order.
Triangulation triangulated(const SpacePoints& x, std::span<const SurfaceFace> faces,
                           std::span<const Index> chosen, std::span<const Index> nodes);

/// surface_through() some faces.
std::shared_ptr<const Surface> surface_over(const SpacePoints& x,
                                            std::span<const SurfaceFace> faces,
                                            std::span<const Index> chosen,
                                            const FeatureCurves& curves);

}  // namespace winslow
