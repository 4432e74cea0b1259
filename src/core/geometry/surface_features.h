#pragma once

#include <map>

#include "core/geometry/curve.h"
#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/triangulation.h"
#include "core/mesh/surface_faces.h"
#include "core/types.h"

namespace winslow {

/// Consecutive nodes along edges. A closed chain does not repeat its first node.
struct Chain {
  std::vector<Index> nodes;
  bool closed = false;

  /// Whether the chain is open and both of its ends are the same node.
  bool loop() const { return !closed && nodes.size() > 1 && nodes.front() == nodes.back(); }
};

/// For each node, the other ends of its edges.
using EdgeEnds = std::map<Index, std::vector<Index>>;

/// Divides edges into chains. Chains continue through nodes for which `passes` is true, which must
/// have two edges, and end at other nodes. Chains without such an end are closed.
std::vector<Chain> find_chains(const EdgeEnds& ends, const std::function<bool(Index)>& passes);

/// The position of a node relative to the features of a surface.
enum class SurfaceNode : std::uint8_t {
  none,    ///< not on the surface
  inside,  ///< on no feature
  line,    ///< a feature line runs through it
  corner   ///< feature lines end, meet or turn there, or it is the tip of a cone
};

/// The features of a surface: edges at which it turns by more than an angle, edges of its border,
/// between markers and of more than two faces.
struct SurfaceFeatures {
  std::vector<SurfaceNode> nodes;  ///< #nodes of the mesh
  std::vector<Chain> lines;        ///< along feature edges, from corner to corner or closed
  std::vector<std::vector<Index>> regions;  ///< faces of each, see connected_faces()
  /// Corners that are due to the angle alone, ascending: bends of one feature line, and tips.
  std::vector<Index> bends, tips;
};

/// angle: in degrees. x: of all nodes of the mesh. smooth: nodes that are no corners, even if a
/// feature line turns there or the surface has a tip.
SurfaceFeatures find_features(const Coordinates& x, std::span<const SurfaceFace> faces,
                              double angle, std::span<const Index> smooth = {});

/// Curves along feature lines (curve_through()).
struct FeatureCurves {
  /// One per line; null for lines of fewer than two nodes, and loops of fewer than four.
  std::vector<std::shared_ptr<const SpaceCurve>> curves;
  /// Tangents at nodes through which a line runs (#nodes); zero elsewhere.
  std::vector<Vec3> tangents;
};
FeatureCurves curves_along(const SpacePoints& x, const SurfaceFeatures& features);

/// Groups of faces that are connected by edges that are no cuts, in the order of their first faces.
/// cuts: not 0 for a cut (#edges).
std::vector<std::vector<Index>> connected_faces(std::size_t face_count, const SurfaceEdges& edges,
                                                std::span<const unsigned char> cuts);

/// The nodes of some faces, ascending.
std::vector<Index> nodes_of_faces(std::span<const SurfaceFace> faces,
                                  std::span<const Index> chosen);

/// Triangles of some faces, which are cut as by triangles_of(). nodes: of the
/// faces, ascending; the points of the triangles are in this order.
Triangulation triangulated(const SpacePoints& x, std::span<const SurfaceFace> faces,
                           std::span<const Index> chosen, std::span<const Index> nodes);

/// The surface_through() some faces.
std::shared_ptr<const Surface> surface_over(const SpacePoints& x,
                                            std::span<const SurfaceFace> faces,
                                            std::span<const Index> chosen,
                                            const FeatureCurves& curves);

}  // namespace winslow
