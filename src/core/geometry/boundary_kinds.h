#pragma once

#include <map>
#include <span>
#include <string>

#include "core/error.h"
#include "core/geometry/sliding_boundary.h"
#include "core/geometry/surface_features.h"

/// The parts of SlidingBoundary::find().
namespace winslow {

/// Which part of a boundary each node that slides is on.
class NodeParts {
 public:
  void set(Index node, Index part) { part_of_[node] = part; }
  /// Throws UsageError for a node that does not slide.
  Index of(Index node) const {
    const auto found = part_of_.find(node);
    if (found == part_of_.end())
      throw UsageError("node " + std::to_string(node) + " has nothing to slide on");
    return found->second;
  }

 private:
  std::map<Index, Index> part_of_;
};

// Each has the nodes slide that the rules hold, too, and throws UsageError for smooth ones that
// cannot slide.

/// Of a plane mesh. markers: indices.
SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, const FeatureRules& rules);
/// Of a volume mesh; of a surface mesh, whose elements all take part, markers is empty.
SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    std::span<const Index> markers, const FeatureRules& rules);
/// The same on another surface: see SlidingBoundary::find().
SlidingBoundary sliding_on_reference(const Topology& topology, const Coordinates& x,
                                     std::span<const Index> markers, const FeatureRules& rules,
                                     const ReferenceSurface& reference);

/// Throws UsageError for the first smooth node of the rules that does not slide in space: `nodes`
/// is what each is, `stays` 1 for those that meet the boundary that does not slide.
void require_smooth(const FeatureRules& rules, std::span<const SurfaceNode> nodes,
                    std::span<const unsigned char> stays);

}  // namespace winslow
