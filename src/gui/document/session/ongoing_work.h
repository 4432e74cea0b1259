#pragma once

#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"

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

}  // namespace winslow::gui
