#pragma once

#include "core/strategy/mesh_state.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// What a run of a volume mesh begins from: its sliding nodes on the reference surface of its
/// options.
struct ReferenceStart {
  MeshState state;
  /// As RunOptions::start; none where there was none, and where it would have inverted elements.
  std::optional<Coordinates> start;
};

/// Puts the nodes that slide onto the reference surface. Throws UsageError for one that nothing
/// slides on.
ReferenceStart put_on_reference(const ResolvedSlide& slide, const MeshState& state,
                                const Coordinates* start);

/// A motion leads through valid meshes. Throws UsageError where nodes that were put onto the
/// surface have inverted elements of the mesh.
void require_no_more_inverted(const SlideOptions& slide, const Mesh& before, const Mesh& placed);

}  // namespace winslow
