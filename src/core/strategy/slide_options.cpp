#include "core/strategy/slide_options.h"

#include <algorithm>

#include "core/error.h"

namespace winslow {

OptionTable option_table(SlideOptions& slide) {
  return {
      {.key = "markers",
       .value = NamesOption{&slide.markers},
       .label = "Sliding markers",
       .help = "Markers whose nodes may slide along the boundary, which keeps its shape: corners "
               "stay; variational form only",
       .advice = "Far fields, walls of a channel and planes of symmetry that a moving body draws "
                 "the mesh along.",
       .object = "slide",
       .flag = "slide",
       .applies = slide.given()},
      {.key = "feature_angle",
       .value = RealOption{&slide.feature_angle, between(0, 180)},
       .label = "Feature angle",
       .help = "Where a sliding marker turns by more than this is a corner, which stays",
       .unit = "degrees",
       .object = "slide",
       .flag = "feature-angle",
       .applies = slide.given()},
  };
}

std::vector<SlidingPart> make_slide(const SlideOptions& slide, const Mesh& mesh,
                                    std::span<const Index> moving, NodeClasses& classes) {
  if (!slide.given()) return {};
  const SlidingBoundary boundary =
      SlidingBoundary::find(*mesh.topology, mesh.coordinates, slide.markers, slide.feature_angle);
  for (const SlidingPart& part : boundary.parts) {
    const auto both = std::ranges::find_if(
        part.nodes, [&](Index node) { return std::ranges::find(moving, node) != moving.end(); });
    if (both != part.nodes.end())
      throw UsageError("marker \"" + part.marker +
                       "\" is to slide, and the motion takes its nodes");
    classes.set_sliding(part.nodes, boundary.geometry, mesh.coordinates);
  }
  return boundary.parts;
}

}  // namespace winslow
