#pragma once

#include <string>
#include <vector>

#include "core/geometry/sliding_boundary.h"
#include "core/mesh/mesh.h"
#include "core/options/option.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// Markers whose nodes slide while the mesh is smoothed, on what they lie on in the mesh that the
/// command is given.
struct SlideOptions {
  std::vector<std::string> markers;
  double feature_angle = 40;  ///< degrees by which a marker turns at a corner, which stays

  bool given() const { return !markers.empty(); }
  bool operator==(const SlideOptions&) const = default;
};

OptionTable option_table(SlideOptions& slide);

/// Has the nodes of the markers slide. Returns what they slide on. Throws UsageError as
/// SlidingBoundary::find() does, and for a node of them that `moving`, the nodes of a motion, has.
std::vector<SlidingPart> make_slide(const SlideOptions& slide, const Mesh& mesh,
                                    std::span<const Index> moving, NodeClasses& classes);

}  // namespace winslow
