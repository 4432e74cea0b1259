#pragma once

#include "core/error.h"
#include "core/geometry/sliding_boundary.h"
#include "core/geometry/surface_features.h"

/// The parts of SlidingBoundary::find().
namespace winslow {

/// Which part of a boundary each node that slides is on.
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

/// What of the boundary each node of a periodic pair lies on, besides its own side.
class CornerMarkers {
 public:
  CornerMarkers(const Topology& topology, std::span<const Index> sliding);
  /// The sliding marker at a node of a pair, if there is one and no marker besides but the sides.
  std::optional<Index> sliding_at(Index node, const PeriodicPairs& pairs) const;
  /// Whether a sliding marker is there at all.
  bool meets_sliding(Index node) const;
  /// Throws UsageError where one node of a pair meets a sliding marker and the other does not.
  void require_both(const Coordinates& x, const PeriodicPair& pair) const;

 private:
  const Topology& topology_;
  std::vector<Index> sliding_;
  std::map<Index, std::vector<Index>> markers_at_;  // of nodes of more than one
};

/// Throws UsageError: a node of a pair is on a marker that slides, but for its partner `what`.
[[noreturn]] void refuse_corner(const Coordinates& x, Index on_sliding, Index partner,
                                const std::string& marker, const std::string& what);

// Each has the nodes slide that the rules hold, too, and throws UsageError for smooth ones that
// cannot slide.

/// Of a plane mesh. markers: indices.
SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, const FeatureRules& rules,
                                  std::span<const PeriodicPairs> periodic);
/// Of a volume mesh; of a surface mesh, whose elements all take part, markers is empty.
SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    std::span<const Index> markers, const FeatureRules& rules,
                                    std::span<const PeriodicPairs> periodic);

/// The same on another surface: see SlidingBoundary::find().
SlidingBoundary sliding_on_reference(const Topology& topology, const Coordinates& x,
                                     std::span<const Index> markers, const FeatureRules& rules,
                                     const ReferenceSurface& reference);

/// Throws UsageError for the first smooth node of the rules that does not slide in space: `nodes`
/// is what each is, `stays` 1 for those that meet the boundary that does not slide.
void require_smooth(const FeatureRules& rules, std::span<const SurfaceNode> nodes,
                    std::span<const unsigned char> stays);

}  // namespace winslow
