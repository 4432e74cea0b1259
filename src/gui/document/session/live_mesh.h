#pragma once

#include "core/mesh/topology.h"
#include "gui/document/history/document.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"
#include "gui/document/selection/boundary_index.h"

namespace winslow::gui {

/// What is being done to the open mesh and is not in its history yet: the job of the solver, the
/// drag under the mouse. Of the two the drag is what is seen.
class OngoingWork {
 public:
  JobRunner& job() { return job_; }
  const JobRunner& job() const { return job_; }
  BodyDrag& drag() { return drag_; }
  /// The drag under the mouse that shows valid meshes only; null without one, and in the paper's
  /// direct mode, where the job shows what the solver has.
  const BodyDrag* body_drag() const { return drag_.active() ? &drag_ : nullptr; }
  /// Begins such a drag from a mesh, which may be that of the drag before: that one ends here.
  /// Throws what BodyDrag::begin throws.
  void begin_drag(MeshState base, DragGrip grip, const SmoothOptions& options,
                  std::optional<DragSession::Start> start, const ResolveFiles& files = no_files);
  bool active() const { return job_.active() || drag_.active(); }

  // Of what is seen; null while nothing is under way.
  const Coordinates* coordinates() const;
  /// That coordinates() are of: a job may change it on its way.
  const std::shared_ptr<const Topology>* topology() const;
  /// The mesh that it began with.
  const MeshState* base() const;

  /// What the mouse holds, and the mesh follows.
  struct Held {
    bool body = false, vcv = false;
  };
  Held& held() { return held_; }
  const Held& held() const { return held_; }

  /// VCVs as the job edits them.
  struct EditedVcvs {
    std::shared_ptr<const VirtualControlVolumes> plane;
    /// Of a volume mesh; null within: none is given by hand.
    std::optional<std::shared_ptr<const SphereStencils>> sphere;
  };
  void set_edited_vcvs(EditedVcvs edited) { edited_ = std::move(edited); }
  /// Null unless the job under way edits VCVs.
  const EditedVcvs* edited_vcvs() const;

 private:
  JobRunner job_;
  BodyDrag drag_;
  MeshState drag_base_;  // that the drag's motions are seen from
  Held held_;
  EditedVcvs edited_;
};

/// A mesh as one object that stays as it is, for threads and for what keeps it: none is made while
/// nodes stay where they are.
class SharedMesh {
 public:
  /// shape: see LiveMesh::shape(). given: the mesh itself, if there is such an object already.
  const std::shared_ptr<const Mesh>& of(const std::shared_ptr<const Topology>& topology,
                                        const Coordinates& coordinates, std::uint64_t shape,
                                        const std::shared_ptr<const Mesh>& given);
  void forget() { mesh_.reset(); }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::uint64_t shape_ = 0;
};

/// The open mesh as it is on screen: that of its document, or of the job or the drag under way.
class LiveMesh {
 public:
  /// work: what is done to this mesh; it outlives this object.
  explicit LiveMesh(const OngoingWork& work) : work_(work) {}

  /// Null: no mesh is open.
  Document* document() { return document_.get(); }
  const Document* document() const { return document_.get(); }
  /// Puts a document in place of the one that is open, if any.
  void open(std::unique_ptr<Document> document);
  void close();
  /// Grows when another mesh is opened, or the open one closed.
  std::uint64_t generation() const { return generation_; }

  const OngoingWork& work() const { return work_; }
  /// The mesh on screen is not (yet) one of the history.
  bool in_motion() const { return work_.active(); }

  /// The mesh on screen.
  const Coordinates& coordinates() const;
  /// That coordinates() are of: a job may change it on its way. Null without a mesh.
  const std::shared_ptr<const Topology>& topology() const;
  /// Both, as a mesh that stays as it is. Null without a mesh.
  std::shared_ptr<const Mesh> shared() const;
  /// Layers of the mesh on screen; null where there are none, or not all of them yet.
  std::shared_ptr<const LayerStack> layers() const;
  /// Virtual control volumes of the mesh on screen; null without a mesh.
  std::shared_ptr<const VirtualControlVolumes> vcv() const;
  /// VCVs of a volume mesh on screen that were given by hand; null: none.
  std::shared_ptr<const SphereStencils> sphere_vcvs() const;
  /// Null without a plane mesh.
  const BoundaryIndex* boundary() const { return boundary_.get(); }
  /// State that live_motion() is seen from.
  const MeshState& motion_base() const;
  /// Motion of the job or drag under way, of one body, from the state that it started from:
  /// resolved.
  std::optional<RigidMotion> live_motion() const;
  /// Of the job under way, or else of the command that led to the present mesh.
  std::span<const IterationRecord> convergence() const;

  /// Shows other coordinates of the mesh on screen, for a picture; none: no more.
  void show_instead(std::optional<Coordinates> coordinates);
  /// Grows whenever coordinates() may have changed.
  std::uint64_t shape() const { return shape_; }
  /// Call it when coordinates() may have changed.
  void changed();
  /// `tell` is called when the mesh on screen has come to be of another connectivity; `now` is null
  /// when the mesh was closed.
  using Rebuilt = std::function<void(const std::shared_ptr<const Topology>& before,
                                     const std::shared_ptr<const Topology>& now)>;
  void when_rebuilt(Rebuilt tell) { rebuilt_ = std::move(tell); }

 private:
  void follow_topology();

  const OngoingWork& work_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<BoundaryIndex> boundary_;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::optional<Coordinates> instead_;  // of those of the document or of the work
  // While a job shows a mesh of another connectivity than the document's.
  std::shared_ptr<const VirtualControlVolumes> passing_;
  Rebuilt rebuilt_;
  mutable SharedMesh shared_;  // made as it is asked for
};

/// A volume mesh or a surface mesh is open.
inline bool in_space(const LiveMesh& mesh) {
  return mesh.document() && mesh.document()->boundary();
}
/// Of the open mesh; of what could be opened, where there is none, a plane one.
inline MeshKind kind_of(const LiveMesh& mesh) {
  return mesh.topology() ? mesh.topology()->kind() : MeshKind::plane;
}

}  // namespace winslow::gui
