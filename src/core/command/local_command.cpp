#include "core/command/local_command.h"

namespace winslow {

namespace {

// A missing third component is 0 in the mesh's coordinates, but not in the frame. The number of
// given components is preserved.
void put_in_frame(std::vector<MovingBody>& bodies, const LocalFrame& frame) {
  for (MovingBody& body : bodies)
    if (body.motion.pivot) *body.motion.pivot -= frame.origin();
}

void put_in_frame(MoveCommand& command, const LocalFrame& frame) {
  put_in_frame(command.bodies, frame);
}

void put_in_frame(DeformCommand& command, const LocalFrame& frame) {
  if (auto* table = std::get_if<DisplacementTable>(&command.shape)) {
    for (DisplacementEntry& entry : table->entries)
      if (!entry.node) entry.position -= frame.origin();
  }
  if (auto* table = std::get_if<PositionTable>(&command.shape))
    for (PositionEntry& entry : table->entries) entry.position -= frame.origin();
}

void put_in_frame(LayersCommand& command, const LocalFrame& frame) {
  const Vec2 origin = frame.origin().head<2>();
  for (LayerWall& wall : command.layers.walls) {
    wall.part.xmin -= origin.x();
    wall.part.xmax -= origin.x();
    wall.part.ymin -= origin.y();
    wall.part.ymax -= origin.y();
  }
}

// These commands contain no positions.
void put_in_frame(SmoothCommand&, const LocalFrame&) {}
void put_in_frame(ScrambleCommand&, const LocalFrame&) {}
void put_in_frame(EditVcvCommand&, const LocalFrame&) {}

void put_in_frame(NearStart& near, const LocalFrame& frame) {
  put_in_frame(near.way, frame);
  for (std::vector<MovingBody>& bodies : near.beside) put_in_frame(bodies, frame);
  for (auto& mesh : near.earlier) mesh = std::make_shared<const Coordinates>(frame.to_local(*mesh));
}

/// Converts the positions in a result.
void put_in_mesh(SmoothResult& result, const LocalFrame& frame) {
  if (result.contact) put_in_mesh(result.contact->edges, frame);
  if (result.gap) put_in_mesh(result.gap->edges, frame);
}

/// Refuses entries that match no node, before the conversion: messages show the user's positions.
void check_places(const Command& command, const MeshState& state) {
  const auto* deform = std::get_if<DeformCommand>(&command);
  if (deform == nullptr) return;
  std::visit(
      [&](const auto& shape) {
        make_motion(*state.mesh.topology, state.mesh.coordinates, deform->markers, shape);
      },
      deform->shape);
}

/// Converts intermediate meshes for another monitor.
class MonitorInFrame final : public SolverMonitor {
 public:
  MonitorInFrame(SolverMonitor* monitor, const LocalFrame& frame, const Coordinates& rest)
      : monitor_(monitor), frame_(frame), rest_(rest) {}

  void on_topology(const std::shared_ptr<const Topology>& topology) override {
    if (monitor_) monitor_->on_topology(topology);
  }
  bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
    return !monitor_ || monitor_->on_iteration(record, frame_.to_mesh(x, rest_));
  }
  bool cancelled() override { return monitor_ && monitor_->cancelled(); }

 private:
  SolverMonitor* monitor_;
  const LocalFrame& frame_;
  const Coordinates& rest_;
};

/// The command in the coordinates of a frame: pivots, positions of displacements, boxes of walls.
Command in_frame(Command command, const LocalFrame& frame) {
  std::visit([&](auto& c) { put_in_frame(c, frame); }, command);
  if (SmoothOptions* smooth = smooth_options(command))
    smooth->keep_outside = to_local(std::move(smooth->keep_outside), frame);
  return command;
}

}  // namespace

CommandResult carry_out_in(const LocalFrame& frame, const Command& command, const MeshState& state,
                           const RunOptions& options, const CarryOut& carry_out) {
  check_places(command, state);
  MeshState local{frame.to_local(state.mesh), state.vcvs, state.roles, state.layers};
  local.held_walls = state.held_walls;
  if (state.reference)
    local.reference = std::make_shared<const Coordinates>(frame.to_local(*state.reference));
  MonitorInFrame monitor(options.monitor, frame, state.mesh.coordinates);
  RunOptions local_options = options;
  local_options.monitor = &monitor;
  Coordinates start;
  if (options.start != nullptr) {
    start = frame.to_local(*options.start);
    local_options.start = &start;
  }
  put_in_frame(local_options.near, frame);
  if (auto& surface = local_options.files.reference) surface = moved_to(*surface, frame.origin());
  CommandResult result = carry_out(in_frame(command, frame), local, local_options);
  Coordinates& x = result.state.mesh.coordinates;
  x = frame.to_mesh(std::move(x), state.mesh.coordinates);
  put_in_mesh(result.smooth, frame);
  return result;
}

}  // namespace winslow
