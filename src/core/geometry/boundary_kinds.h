#pragma once

#include <map>
#include <span>
#include <string>

#include "core/error.h"
#include "core/geometry/sliding_boundary.h"

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

/// Of a plane mesh. markers: indices; feature_angle: in degrees.
SlidingBoundary sliding_on_curves(const Topology& topology, const Coordinates& x,
                                  std::span<const Index> markers, double feature_angle);
/// Of a volume mesh; of a surface mesh, whose elements all take part, markers is empty.
SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    std::span<const Index> markers, double feature_angle,
                                    bool features);

/// The same on another surface: see SlidingBoundary::find().
SlidingBoundary sliding_on_reference(const Topology& topology, const Coordinates& x,
                                     std::span<const Index> markers, double feature_angle,
                                     bool features, const ReferenceSurface& reference);

}  // namespace winslow
