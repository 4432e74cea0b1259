#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "gui/document/history/document.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"
#include "gui/document/selection/boundary_index.h"

namespace winslow::gui {

/// The open mesh as it is on screen: that of its document, or of the job or the drag under way.
class LiveMesh {
 public:
  /// Null: no mesh is open.
  Document* document() { return document_.get(); }
  const Document* document() const { return document_.get(); }
  /// Puts a document in place of the one that is open, if any.
  void open(std::unique_ptr<Document> document);
  void close();
  /// Grows when another mesh is opened, or the open one closed.
  std::uint64_t generation() const { return generation_; }

  JobRunner& job() { return job_; }
  const JobRunner& job() const { return job_; }
  BodyDrag& drag() { return drag_; }
  /// The drag under the mouse that shows valid meshes only; null without one, and in the paper's
  /// direct mode, where the job shows what the solver has.
  const BodyDrag* body_drag() const { return drag_.active() ? &drag_ : nullptr; }
  /// Begins such a drag from the mesh on screen. Throws what BodyDrag::begin throws.
  void begin_drag(DragGrip grip, const SmoothOptions& options,
                  std::optional<DragSession::Start> start);
  /// What the mouse holds, and the mesh follows.
  struct Held {
    bool body = false, vcv = false;
  };
  Held& held() { return held_; }
  const Held& held() const { return held_; }
  /// The mesh on screen is not (yet) one of the history.
  bool in_motion() const { return job_.active() || drag_.active(); }

  /// The mesh on screen.
  const Coordinates& coordinates() const;
  /// That coordinates() are of: a job may change it on its way. Null without a mesh.
  const std::shared_ptr<const Topology>& topology() const;
  /// Layers of the mesh on screen; null where there are none, or not all of them yet.
  std::shared_ptr<const LayerStack> layers() const;
  /// Virtual control volumes of the mesh on screen; null without a mesh.
  std::shared_ptr<const VirtualControlVolumes> vcv() const;
  /// What is shown in place of what the document or the job has. After another mesh: changed().
  struct Instead {
    /// Edited ones, while the job that edits them is under way.
    std::shared_ptr<const VirtualControlVolumes> vcv;
    /// The same of a volume mesh; null within: none is edited.
    std::optional<std::shared_ptr<const SphereStencils>> sphere_vcvs;
    /// Of the mesh on screen, for a picture.
    std::optional<Coordinates> coordinates;
  };
  Instead& instead() { return instead_; }
  /// Null without a plane mesh.
  const BoundaryIndex* boundary() const { return boundary_.get(); }
  /// State that live_motion() is seen from.
  const MeshState& motion_base() const;
  /// Motion of the job or drag under way, of one body, from the state that it started from:
  /// resolved.
  std::optional<RigidMotion> live_motion() const;
  /// Of the job under way, or else of the command that led to the present mesh.
  std::span<const IterationRecord> convergence() const;

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
  friend std::shared_ptr<const SphereStencils> sphere_vcvs(const LiveMesh& mesh);
  friend std::shared_ptr<const Mesh> shared_mesh(const LiveMesh& live);
  /// Reference surfaces that commands and drags name.
  friend const std::shared_ptr<ReferenceFiles>& reference_files(const LiveMesh& mesh) {
    return mesh.references_;
  }
  void follow_topology();

  std::unique_ptr<Document> document_;
  std::unique_ptr<BoundaryIndex> boundary_;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::shared_ptr<ReferenceFiles> references_ = std::make_shared<ReferenceFiles>();
  JobRunner job_{references_};
  BodyDrag drag_{references_};
  MeshState drag_base_;  // that the drag's motions are seen from
  Held held_;
  Instead instead_;
  // While a job shows a mesh of another connectivity than the document's.
  std::shared_ptr<const VirtualControlVolumes> passing_;
  Rebuilt rebuilt_;
  mutable std::shared_ptr<const Mesh> shared_;
  mutable std::uint64_t shared_shape_ = 0;
};

/// A volume mesh or a surface mesh is open.
inline bool in_space(const LiveMesh& mesh) {
  return mesh.document() && mesh.document()->boundary();
}
/// The mesh on screen as one that stays as it is, for threads and for what keeps it: none is made
/// while nodes stay where they are. Null without a mesh.
std::shared_ptr<const Mesh> shared_mesh(const LiveMesh& live);
/// VCVs of a volume mesh on screen that were given by hand; null: none.
std::shared_ptr<const SphereStencils> sphere_vcvs(const LiveMesh& mesh);

}  // namespace winslow::gui
