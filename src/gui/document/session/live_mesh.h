#pragma once

#include "core/mesh/topology.h"
#include "gui/document/history/document.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"
#include "gui/document/selection/boundary_index.h"

namespace winslow::gui {

/// Work on the open mesh that is not in its history yet: the solver's job and the drag. If both are
/// active, the drag is shown.
class OngoingWork {
 public:
  JobRunner& job() { return job_; }
  const JobRunner& job() const { return job_; }
  BodyDrag& drag() { return drag_; }
  /// The active drag, which shows only valid meshes; null without one, and in the paper's direct
  /// mode, where the job shows the solver's iterates.
  const BodyDrag* body_drag() const { return drag_.active() ? &drag_ : nullptr; }
  /// Begins a drag from a mesh, which may be that of the previous drag; a previous drag ends here.
  /// Throws the exceptions of BodyDrag::begin.
  void begin_drag(MeshState base, DragGrip grip, const SmoothOptions& options,
                  std::optional<DragSession::Start> start, const ResolveFiles& files = no_files);
  bool active() const { return job_.active() || drag_.active(); }

  // Of the work that is shown; null while none is active.
  const Coordinates* coordinates() const;
  /// Topology of coordinates(): a running job may change it.
  const std::shared_ptr<const Topology>* topology() const;
  /// The mesh at its start.
  const MeshState* base() const;

  /// The object that the mouse drags and the mesh follows.
  struct Held {
    bool body = false, vcv = false;
  };
  Held& held() { return held_; }
  const Held& held() const { return held_; }

  /// VCVs edited by the job.
  struct EditedVcvs {
    std::shared_ptr<const VirtualControlVolumes> plane;
    /// Of a volume mesh; contains null if none is edited by hand.
    std::optional<std::shared_ptr<const SphereStencils>> sphere;
  };
  void set_edited_vcvs(EditedVcvs edited) { edited_ = std::move(edited); }
  /// Null unless the running job edits VCVs.
  const EditedVcvs* edited_vcvs() const;

 private:
  JobRunner job_;
  BodyDrag drag_;
  MeshState drag_base_;  // reference of the drag's motions
  Held held_;
  EditedVcvs edited_;
};

/// Caches the mesh as an immutable object for threads and for owners that keep it; makes a new one
/// only after nodes have moved.
class SharedMesh {
 public:
  /// shape: see LiveMesh::shape(). given: such an object, if one exists already.
  const std::shared_ptr<const Mesh>& of(const std::shared_ptr<const Topology>& topology,
                                        const Coordinates& coordinates, std::uint64_t shape,
                                        const std::shared_ptr<const Mesh>& given);
  void forget() { mesh_.reset(); }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::uint64_t shape_ = 0;
};

/// The open mesh as shown on screen: that of its document, or of the active job or drag.
class LiveMesh {
 public:
  /// work: the work on this mesh; must outlive this object.
  explicit LiveMesh(const OngoingWork& work) : work_(work) {}

  /// Null: no mesh is open.
  Document* document() { return document_.get(); }
  const Document* document() const { return document_.get(); }
  /// Opens a document, replacing the open one, if any.
  void open(std::unique_ptr<Document> document);
  void close();
  /// Increases whenever a mesh is opened or closed.
  std::uint64_t generation() const { return generation_; }

  const OngoingWork& work() const { return work_; }
  /// True while the mesh on screen is not (yet) in the history.
  bool in_motion() const { return work_.active(); }

  /// The mesh on screen.
  const Coordinates& coordinates() const;
  /// Topology of coordinates(): a running job may change it. Null without a mesh.
  const std::shared_ptr<const Topology>& topology() const;
  /// Both, as an immutable mesh. Null without a mesh.
  std::shared_ptr<const Mesh> shared() const;
  /// Layers of the mesh on screen; null if it has none, or not all of them yet.
  std::shared_ptr<const LayerStack> layers() const;
  /// Virtual control volumes of the mesh on screen; null without a mesh.
  std::shared_ptr<const VirtualControlVolumes> vcv() const;
  /// Hand-edited VCVs of the volume mesh on screen; null: none.
  std::shared_ptr<const SphereStencils> sphere_vcvs() const;
  /// Null without a plane mesh.
  const BoundaryIndex* boundary() const { return boundary_.get(); }
  /// Reference state of live_motion().
  const MeshState& motion_base() const;
  /// Resolved motion of the active job or drag of one body, relative to its start.
  std::optional<RigidMotion> live_motion() const;
  /// Convergence of the running job, or else of the command that led to the present mesh.
  std::span<const IterationRecord> convergence() const;

  /// Shows other coordinates of the mesh on screen, for a picture; none: the actual ones.
  void show_instead(std::optional<Coordinates> coordinates);
  /// Increases whenever coordinates() may have changed.
  std::uint64_t shape() const { return shape_; }
  /// To be called when coordinates() may have changed.
  void changed();
  /// `tell` is called when the connectivity of the mesh on screen has changed; `now` is null when
  /// the mesh was closed.
  using Rebuilt = std::function<void(const std::shared_ptr<const Topology>& before,
                                     const std::shared_ptr<const Topology>& now)>;
  void when_rebuilt(Rebuilt tell) { rebuilt_ = std::move(tell); }

 private:
  void follow_topology();

  const OngoingWork& work_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<BoundaryIndex> boundary_;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::optional<Coordinates> instead_;  // shown instead of the actual coordinates
  // VCVs while a job shows a mesh whose connectivity differs from the document's.
  std::shared_ptr<const VirtualControlVolumes> passing_;
  Rebuilt rebuilt_;
  mutable SharedMesh shared_;  // made on request
};

/// A volume mesh or a surface mesh is open.
inline bool in_space(const LiveMesh& mesh) {
  return mesh.document() && mesh.document()->boundary();
}
/// Kind of the open mesh; plane if none is open.
inline MeshKind kind_of(const LiveMesh& mesh) {
  return mesh.topology() ? mesh.topology()->kind() : MeshKind::plane;
}

}  // namespace winslow::gui
