#include "core/strategy/reference_start.h"

#include "core/error.h"
#include "core/quality/quality.h"

namespace winslow {

ReferenceStart put_on_reference(const ResolvedSlide& slide, const MeshState& state,
                                const Coordinates* start) {
  if (slide.markers.empty())
    throw UsageError(slide.reference +
                     ": a reference surface is for nodes that slide: name their markers");
  const Topology& topology = *state.mesh.topology;
  const SlidingBoundary boundary =
      SlidingBoundary::find(topology, state.mesh.coordinates, slide.markers, feature_rules(slide),
                            slide.files().reference.get());
  ReferenceStart out{state, std::nullopt};
  out.state.mesh.coordinates = put_on(boundary, std::move(out.state.mesh.coordinates));
  if (start == nullptr) return out;
  out.start = *start;
  // What is no mesh of this kind is refused by the run.
  if (start->size() != state.mesh.coordinates.size() || start->dimension() != 3) return out;
  out.start = put_on(boundary, std::move(*out.start));
  if (check_validity(topology, *out.start).inverted > check_validity(topology, *start).inverted)
    out.start.reset();
  return out;
}

void require_no_more_inverted(const SlideOptions& slide, const Mesh& before, const Mesh& placed) {
  const Index had = check_validity(*before.topology, before.coordinates).inverted;
  const Index has = check_validity(*placed.topology, placed.coordinates).inverted;
  if (has > had)
    throw UsageError(slide.reference + ": with their nodes put onto this surface " +
                     std::to_string(has) + " elements are inverted: smooth the mesh on it first");
}

}  // namespace winslow
