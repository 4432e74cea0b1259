#include "core/command/motion_frames.h"

#include "core/motion/transfer.h"

namespace winslow {
namespace {

/// Collects the mesh after every iteration, in long solves after every second, fourth, ...: at most
/// a few hundred.
class MeshCollector : public SolverMonitor {
 public:
  MeshCollector(std::shared_ptr<const Topology> topology, const FrameChoice& choice)
      : topology_(std::move(topology)),
        cancelled_(choice.cancelled),
        most_(std::max(4 * choice.per_command, 256)) {}

  void on_topology(const std::shared_ptr<const Topology>& topology) override {
    topology_ = topology;
  }
  bool on_iteration(const IterationRecord&, const Coordinates& x) override {
    if (seen_++ % stride_ == 0) meshes_.push_back({topology_, x});
    if (static_cast<int>(meshes_.size()) > most_) {
      for (std::size_t k = 0; 2 * k < meshes_.size(); ++k) meshes_[k] = meshes_[2 * k];
      meshes_.resize((meshes_.size() + 1) / 2);
      stride_ *= 2;
    }
    return !cancelled();
  }
  bool cancelled() override { return cancelled_ && cancelled_(); }

  std::vector<Mesh> release() { return std::move(meshes_); }

 private:
  std::shared_ptr<const Topology> topology_;
  const std::function<bool()>& cancelled_;
  int most_;
  int stride_ = 1, seen_ = 0;
  std::vector<Mesh> meshes_;
};

bool same_place(const Mesh& a, const Mesh& b) {
  return a.coordinates.size() == b.coordinates.size() && a.coordinates == b.coordinates;
}

/// The meshes after `first` with the interpolated meshes between them; without `first`.
std::vector<Mesh> whole_way(const Mesh& first, std::vector<Mesh> meshes,
                            std::span<const std::vector<Index>> moved) {
  std::vector<Mesh> way;
  Mesh last = first;
  for (Mesh& mesh : meshes) {
    if (same_place(last, mesh)) continue;
    if (last.topology == mesh.topology)
      for (Coordinates& x :
           meshes_between(*mesh.topology, moved, last.coordinates, mesh.coordinates))
        way.push_back({mesh.topology, std::move(x)});
    way.push_back(mesh);
    last = std::move(mesh);
  }
  return way;
}

}  // namespace

std::vector<std::vector<Index>> moved_as_bodies(const Command& command, const Topology& topology) {
  std::vector<std::vector<Index>> moved;
  const auto* move = std::get_if<MoveCommand>(&command);
  if (!move) return moved;
  for (const MovingBody& body : move->bodies) {
    std::vector<Index>& own = moved.emplace_back();
    for (const std::string& name : body.markers) {
      const auto marker = topology.markers().find(name);
      if (!marker) continue;
      const auto nodes = topology.markers().nodes(*marker);
      own.insert(own.end(), nodes.begin(), nodes.end());
    }
  }
  return moved;
}

std::vector<Mesh> motion_frames(const std::vector<ResolvedCommand>& commands, MeshState state,
                                const FrameChoice& choice) {
  std::vector<Mesh> frames{state.mesh};
  for (const ResolvedCommand& command : commands) {
    MeshCollector collector(state.mesh.topology, choice);
    RunOptions options;
    options.monitor = &collector;
    const std::vector<std::vector<Index>> moved =
        moved_as_bodies(command.command(), *state.mesh.topology);
    state = execute(command, state, options).state;
    std::vector<Mesh> meshes = collector.release();
    meshes.push_back(state.mesh);
    const std::vector<Mesh> way = whole_way(frames.back(), std::move(meshes), moved);
    const std::size_t wanted =
        choice.per_command > 0 ? static_cast<std::size_t>(choice.per_command) : way.size();
    const std::size_t taken = std::min(wanted, way.size());
    for (std::size_t k = 1; k <= taken; ++k) frames.push_back(way[k * way.size() / taken - 1]);
  }
  return frames;
}

}  // namespace winslow
