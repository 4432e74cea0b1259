#include "gui/document/session/live_mesh.h"

#include <utility>

namespace winslow::gui {

namespace {

/// The motion that is being carried out; null: none is.
const MoveCommand* move_of(const JobRunner& job) {
  return job.active() ? std::get_if<MoveCommand>(&job.command()) : nullptr;
}

}  // namespace

void LiveMesh::open(std::unique_ptr<Document> document) {
  auto boundary =
      document->boundary() ? nullptr : std::make_unique<BoundaryIndex>(document->topology());
  close();
  document_ = std::move(document);
  boundary_ = std::move(boundary);
}

void LiveMesh::close() {
  const std::shared_ptr<const Topology> before = topology();
  document_.reset();
  boundary_.reset();
  passing_.reset();
  shared_.reset();
  ++generation_;
  if (rebuilt_) rebuilt_(before, nullptr);
}

void LiveMesh::begin_drag(DragGrip grip, const SmoothOptions& options,
                          std::optional<DragSession::Start> start) {
  const MeshState base = motion_base();
  drag_.begin(base, std::move(grip), options, std::move(start));
  drag_base_ = base;
}

const Coordinates& LiveMesh::coordinates() const {
  static const Coordinates none;
  if (!document_) return none;
  if (instead_.coordinates) return *instead_.coordinates;
  if (drag_.active()) return drag_.coordinates();
  return job_.active() ? job_.coordinates() : document_->state().mesh.coordinates;
}

const std::shared_ptr<const Topology>& LiveMesh::topology() const {
  static const std::shared_ptr<const Topology> none;
  if (!document_) return none;
  if (drag_.active()) return drag_base_.mesh.topology;
  return job_.active() ? job_.topology() : document_->topology();
}

std::shared_ptr<const Mesh> shared_mesh(const LiveMesh& live) {
  if (!live.document_) return nullptr;
  const auto& topology = live.topology();
  auto& shared = live.shared_;
  if (shared && live.shared_shape_ == live.shape_ && shared->topology == topology) return shared;
  live.shared_shape_ = live.shape_;
  const bool of_job = live.job_.active() && !live.drag_.active() && !live.instead_.coordinates;
  const auto of_snapshot = of_job ? live.job_.snapshot_mesh() : nullptr;
  if (of_snapshot && of_snapshot == shared) return shared;
  // The shape grows with each look at a job, too: the same nodes are the same mesh.
  if (shared && shared->topology == topology && shared->coordinates == live.coordinates())
    return shared;
  shared = of_snapshot;
  if (!shared) shared = std::make_shared<const Mesh>(Mesh{topology, live.coordinates()});
  return shared;
}

std::shared_ptr<const LayerStack> LiveMesh::layers() const {
  if (!document_ || topology() != document_->topology()) return nullptr;
  return document_->state().layers;
}

std::shared_ptr<const VirtualControlVolumes> LiveMesh::vcv() const {
  if (!document_) return nullptr;
  if (passing_) return passing_;
  const bool editing = job_.active() && std::holds_alternative<EditVcvCommand>(job_.command());
  return editing && instead_.vcv ? instead_.vcv : document_->state().vcvs.plane();
}

std::shared_ptr<const SphereStencils> sphere_vcvs(const LiveMesh& mesh) {
  if (!mesh.document_) return nullptr;
  const auto& edited = mesh.instead_.sphere_vcvs;
  const bool editing =
      mesh.job_.active() && std::holds_alternative<EditVcvCommand>(mesh.job_.command());
  return editing && edited ? *edited : mesh.document_->state().vcvs.by_hand();
}

const MeshState& LiveMesh::motion_base() const {
  if (drag_.active()) return drag_base_;
  return job_.active() ? job_.base() : document_->state();
}

std::optional<RigidMotion> LiveMesh::live_motion() const {
  std::optional<RigidMotion> motion;
  if (const BodyDrag* drag = body_drag()) {
    if (drag->grip().rigid()) motion = drag->wanted();
  } else if (const MoveCommand* move = move_of(job_); move && move->bodies.size() == 1) {
    motion = move->bodies.front().motion;
  }
  if (!motion) return std::nullopt;
  return resolve_motion(*motion, motion_base().mesh.coordinates.dimension(), Vec3(0, 0, 0));
}

std::span<const IterationRecord> LiveMesh::convergence() const {
  if (job_.active()) {
    if (!job_.snapshot()) return {};
    return job_.snapshot()->history;
  }
  if (!document_ || document_->history().position() == 0) return {};
  return document_->history().result(document_->history().position()).history;
}

void LiveMesh::changed() {
  ++shape_;
  follow_topology();
  if (boundary_) boundary_->update(coordinates());
}

void LiveMesh::follow_topology() {
  // No command changes the connectivity of a volume mesh.
  if (!boundary_ || boundary_->topology() == topology()) return;
  const std::shared_ptr<const Topology> before = boundary_->topology();
  const std::shared_ptr<const Topology> now = topology();
  boundary_ = std::make_unique<BoundaryIndex>(now);
  if (rebuilt_) rebuilt_(before, now);
  const bool passing = now != document_->topology();
  passing_ = passing ? std::make_shared<const VirtualControlVolumes>(now) : nullptr;
}

}  // namespace winslow::gui
