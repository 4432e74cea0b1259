#pragma once

#include "core/error.h"
#include "core/geometry/curve.h"
#include "core/geometry/sliding_boundary.h"
#include "core/geometry/surface/surface.h"
#include "core/geometry/surface_features.h"
#include "core/mesh/surface_faces.h"

/// The parts of SlidingBoundary::find(), for this folder.
namespace winslow {

/// For each sliding node, its part of the boundary.
class NodeParts {
 public:
  void set(Index node, Index part) {
    if (at(node) >= part_of_.size()) part_of_.resize(at(node) + 1, -1);
    part_of_[at(node)] = part;
  }
  /// Throws UsageError for a node that does not slide.
  Index of(Index node) const {
    if (node < 0 || at(node) >= part_of_.size() || part_of_[at(node)] < 0)
      throw UsageError("node " + std::to_string(node) + " has nothing to slide on");
    return part_of_[at(node)];
  }

 private:
  std::vector<Index> part_of_;  // -1: none
};

/// The indices of markers. Throws UsageError for a marker that the mesh does not have.
std::vector<Index> marker_indices(const Topology& topology, std::span<const std::string> names);

/// The markers that nodes slide on, and all others, at which they stay.
struct SlidingMarkers {
  /// Of the mesh, and behind them its interfaces where parts end or slide there.
  Markers all;
  std::vector<Index> sliding;  ///< indices of `all`
  Index of_mesh = 0;           ///< how many are markers of the mesh
  /// A surface mesh, and nodes slide along the borders of its regions.
  bool along_regions = false;

  SlidingMarkers(const Topology& topology, std::vector<Index> markers, Interfaces interfaces);
  bool slides(Index marker) const { return std::ranges::find(sliding, marker) != sliding.end(); }
  bool of_regions(Index marker) const { return !along_regions && marker >= of_mesh; }
  const std::string& name(Index marker) const { return all[at(marker)].name; }
};

/// The markers at nodes of periodic pairs, besides their own side.
class CornerMarkers {
 public:
  explicit CornerMarkers(const SlidingMarkers& markers);
  /// The sliding marker at a node of a pair; none if there is another marker besides the two sides.
  std::optional<Index> sliding_at(Index node, const PeriodicPairs& pairs) const;
  /// Whether there is a sliding marker at a node.
  bool meets_sliding(Index node) const;
  /// Throws UsageError if only one node of a pair is on a sliding marker.
  void require_both(const Coordinates& x, const PeriodicPair& pair) const;

 private:
  const SlidingMarkers& markers_;
  std::map<Index, std::vector<Index>> markers_at_;  // of nodes on several markers
};

/// Throws UsageError for a node of a pair on a marker that slides. what: the clause about its
/// partner.
[[noreturn]] void refuse_corner(const Coordinates& x, Index on_sliding, Index partner,
                                const std::string& marker, const std::string& what);

// In the results, held nodes of the rules are still among the sliding nodes. Each function throws
// UsageError for smooth nodes that cannot slide.

/// For a plane mesh.
SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  const SlidingMarkers& markers, const FeatureRules& rules,
                                  std::span<const PeriodicPairs> periodic);
/// For a volume mesh, or for a surface mesh: all of its elements, without markers.
SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    const SlidingMarkers& markers, const FeatureRules& rules,
                                    std::span<const PeriodicPairs> periodic);

/// The same on a reference surface, see SlidingBoundary::find().
SlidingBoundary sliding_on_reference(const Topology& topology, const Coordinates& x,
                                     const SlidingMarkers& markers, const FeatureRules& rules,
                                     const ReferenceSurface& reference);

/// Throws UsageError for the first smooth node of the rules that cannot slide in space. stays: 1
/// for nodes on the boundary that does not slide.
void require_smooth(const FeatureRules& rules, std::span<const SurfaceNode> nodes,
                    std::span<const unsigned char> stays);

/// Surfaces and curves in space, and the one on which each node slides.
class SpaceGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override;

  /// x: of all nodes, near the surface.
  void add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
           const SpacePoints& x);
  void add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes);

 private:
  struct Piece {
    std::shared_ptr<const Surface> surface;
    std::shared_ptr<const SpaceCurve> curve;
  };

  struct Slider {
    Index piece;
    Vec3 direction;  // approximate first vector of the node's frame
  };

  std::vector<Piece> pieces_;
  std::vector<Slider> sliders_;
  NodeParts numbers_;  // of the sliders
};

/// The faces that nodes slide on: those of the markers of a volume mesh, or the elements of a
/// surface mesh. stays: 1 for nodes on the boundary that does not slide (#nodes).
struct SlidingFaces {
  std::vector<SurfaceFace> faces;
  std::vector<unsigned char> stays;
};
/// The markers are ignored for a surface mesh. Where nodes slide along the borders of its regions,
/// the marker of a face is the region of the element.
SlidingFaces sliding_faces(const Topology& topology, const SlidingMarkers& markers);

/// The nodes of a region of faces that slide on its surface.
std::vector<Index> nodes_inside(const SlidingFaces& sliding, std::span<const SurfaceNode> nodes,
                                std::span<const Index> region);

/// "straight edge", "edge, circle of radius 1": a feature line for reports.
std::string edge_description(const SpaceCurve& curve);

/// The name of a marker for reports; "surface" for -1 and for a surface mesh.
std::string part_name(const SlidingMarkers& markers, Index marker);
/// The lowest marker of the faces at each node.
std::map<Index, Index> markers_at(std::span<const SurfaceFace> faces);

}  // namespace winslow
