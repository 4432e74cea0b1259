#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

void OngoingWork::begin_drag(MeshState base, DragGrip grip, const SmoothOptions& options,
                             std::optional<DragSession::Start> start, const ResolveFiles& files) {
  drag_.begin(base, std::move(grip), options, std::move(start), files);
  drag_base_ = std::move(base);
}

const Coordinates* OngoingWork::coordinates() const {
  if (drag_.active()) return &drag_.coordinates();
  return job_.active() ? &job_.coordinates() : nullptr;
}

const std::shared_ptr<const Topology>* OngoingWork::topology() const {
  if (drag_.active()) return &drag_base_.mesh.topology;
  return job_.active() ? &job_.topology() : nullptr;
}

const MeshState* OngoingWork::base() const {
  if (drag_.active()) return &drag_base_;
  return job_.active() ? &job_.base() : nullptr;
}

const OngoingWork::EditedVcvs* OngoingWork::edited_vcvs() const {
  const bool editing = job_.active() && std::holds_alternative<EditVcvCommand>(job_.command());
  return editing ? &edited_ : nullptr;
}

namespace {

/// The motion being carried out; null: none.
const MoveCommand* move_of(const JobRunner& job) {
  return job.active() ? std::get_if<MoveCommand>(&job.command()) : nullptr;
}

}  // namespace

const std::shared_ptr<const Mesh>& SharedMesh::of(const std::shared_ptr<const Topology>& topology,
                                                  const Coordinates& coordinates,
                                                  std::uint64_t shape,
                                                  const std::shared_ptr<const Mesh>& given) {
  if (mesh_ && shape_ == shape && mesh_->topology == topology) return mesh_;
  shape_ = shape;
  if (given && given == mesh_) return mesh_;
  // The shape also increases with each poll of a job, even if no node has moved.
  if (mesh_ && mesh_->topology == topology && mesh_->coordinates == coordinates) return mesh_;
  mesh_ = given ? given : std::make_shared<const Mesh>(Mesh{topology, coordinates});
  return mesh_;
}

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
  shared_.forget();
  ++generation_;
  if (rebuilt_) rebuilt_(before, nullptr);
}

const Coordinates& LiveMesh::coordinates() const {
  static const Coordinates none;
  if (!document_) return none;
  if (instead_) return *instead_;
  const Coordinates* of_work = work_.coordinates();
  return of_work ? *of_work : document_->state().mesh.coordinates;
}

const std::shared_ptr<const Topology>& LiveMesh::topology() const {
  static const std::shared_ptr<const Topology> none;
  if (!document_) return none;
  const auto* of_work = work_.topology();
  return of_work ? *of_work : document_->topology();
}

std::shared_ptr<const Mesh> LiveMesh::shared() const {
  if (!document_) return nullptr;
  // The mesh of a job is already such an object.
  const bool of_job = work_.job().active() && !work_.body_drag() && !instead_;
  return shared_.of(topology(), coordinates(), shape_,
                    of_job ? work_.job().snapshot_mesh() : nullptr);
}

std::shared_ptr<const LayerStack> LiveMesh::layers() const {
  if (!document_ || topology() != document_->topology()) return nullptr;
  return document_->state().layers;
}

std::shared_ptr<const VirtualControlVolumes> LiveMesh::vcv() const {
  if (!document_) return nullptr;
  if (passing_) return passing_;
  const auto* edited = work_.edited_vcvs();
  return edited && edited->plane ? edited->plane : document_->state().vcvs.plane();
}

std::shared_ptr<const SphereStencils> LiveMesh::sphere_vcvs() const {
  if (!document_) return nullptr;
  const auto* edited = work_.edited_vcvs();
  return edited && edited->sphere ? *edited->sphere : document_->state().vcvs.by_hand();
}

const MeshState& LiveMesh::motion_base() const {
  const MeshState* of_work = work_.base();
  return of_work ? *of_work : document_->state();
}

std::optional<RigidMotion> LiveMesh::live_motion() const {
  std::optional<RigidMotion> motion;
  if (const BodyDrag* drag = work_.body_drag()) {
    if (drag->grip().rigid()) motion = drag->wanted();
  } else if (const MoveCommand* move = move_of(work_.job()); move && move->bodies.size() == 1) {
    motion = move->bodies.front().motion;
  }
  if (!motion) return std::nullopt;
  return resolve_motion(*motion, motion_base().mesh.coordinates.dimension(), Vec3(0, 0, 0));
}

std::span<const IterationRecord> LiveMesh::convergence() const {
  if (work_.job().active()) {
    const auto& snapshot = work_.job().snapshot();
    if (!snapshot) return {};
    return snapshot->history;
  }
  if (!document_ || document_->history().position() == 0) return {};
  return document_->history().result(document_->history().position()).history;
}

void LiveMesh::show_instead(std::optional<Coordinates> coordinates) {
  instead_ = std::move(coordinates);
  changed();
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
