#pragma once

#include <memory>
#include <span>

#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/vcv_edit.h"

namespace winslow {

/// The VCVs of a volume mesh that are given by hand, with edits applied in their order; null: none
/// is. before: null for none. Throws UsageError naming the node whose numbers are no VCV, or which
/// has none.
std::shared_ptr<const SphereStencils> edit_vcvs(const Topology& topology,
                                                const SphereStencils* before,
                                                std::span<const VcvEdit> edits);

/// The edit that gives a node this VCV.
VcvEdit edit_of(const Topology& topology, Index node, const SphereStencil& stencil);

/// The least solid angle, over 4 pi / #triangles, of the triangles of a link around one of its
/// vertices; of them which one.
struct LeastAngle {
  double share = 0;
  Index triangle = -1;
};
LeastAngle least_angle_at(const SphereLink& link, std::span<const Vec3> directions, Index vertex);

}  // namespace winslow
