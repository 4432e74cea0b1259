#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "core/inspect/space/volume_nodal_view.h"
#include "core/strategy/smooth_options.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// What an inspection of nodes of a volume mesh shows: their VCVs as a run from the mesh of the
/// history would have them (of the kind that the solver is set to, or as edited), over the mesh on
/// screen. Each is worked out when it is first asked for: a whole mesh has more VCVs than one looks
/// at.
class SphereInspector {
 public:
  SphereInspector(const LiveMesh& mesh, const Jobs& jobs) : mesh_(mesh), jobs_(jobs) {}

  /// Valid until the next call of a later frame. Throws UsageError for a node that has no VCV,
  /// MeshError for a star that has none.
  const VolumeNodalView& at(Index node) const;

 private:
  /// What VCVs depend on.
  struct Source {
    std::uint64_t generation = 0;
    std::uint64_t shape = 0;  // of the mesh of the history
    std::size_t position = 0, steps = 0;
    VcvKind kind = VcvKind::automatic;
    double lengths = 0;
    std::shared_ptr<const SphereStencils> by_hand;
    bool operator==(const Source&) const = default;
  };
  void follow() const;
  const NodeVcv& vcv(Index node) const;

  const LiveMesh& mesh_;
  const Jobs& jobs_;
  mutable Source source_;
  mutable std::uint64_t shape_ = 0;
  mutable std::map<Index, NodeVcv> vcvs_;
  mutable std::map<Index, VolumeNodalView> views_;
};

}  // namespace winslow::gui
