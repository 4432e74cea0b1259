#include "gui/document/session/sphere_inspector.h"

#include "core/inspect/nodal_view.h"
#include "core/strategy/solver_options.h"

namespace winslow::gui {

void SphereInspector::follow() const {
  const SmoothOptions& options = jobs_.smooth_options();
  const History& history = mesh_.document()->history();
  // While the mesh is on its way, that of the history stays as it was.
  const std::uint64_t shape = mesh_.in_motion() ? source_.shape : mesh_.shape();
  Source now{mesh_.generation(), shape,       history.position(),
             history.size(),     options.vcv, options.vcv_lengths,
             sphere_vcvs(mesh_)};
  if (now != source_) {
    source_ = std::move(now);
    vcvs_.clear();
    views_.clear();
  }
  if (shape_ != mesh_.shape()) {
    shape_ = mesh_.shape();
    views_.clear();
  }
}

const NodeVcv& SphereInspector::vcv(Index node) const {
  if (const auto found = vcvs_.find(node); found != vcvs_.end()) return found->second;
  const MeshState& state = mesh_.document()->state();
  const SphereStencil* by_hand = nullptr;
  if (source_.by_hand) {
    const auto found = source_.by_hand->find(node);
    if (found != source_.by_hand->end()) by_hand = &found->second;
  }
  const VolumeVcvOptions options = volume_vcv_options(jobs_.smooth_options());
  return vcvs_
      .emplace(node,
               make_node_vcv(*state.mesh.topology, state.mesh.coordinates, node, options, by_hand))
      .first->second;
}

const VolumeNodalView& SphereInspector::at(Index node) const {
  require_inspectable(*mesh_.topology(), node);
  follow();
  if (const auto found = views_.find(node); found != views_.end()) return found->second;
  return views_.emplace(node, inspect_node(*mesh_.topology(), mesh_.coordinates(), vcv(node)))
      .first->second;
}

}  // namespace winslow::gui
