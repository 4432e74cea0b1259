#include "app/job/motion_frames.h"

#include <algorithm>

#include "app/job/interrupt.h"

namespace winslow::app {
namespace {

/// Keeps the mesh after every iteration, or, of long solves, after every second, fourth, ...: no
/// more than a few hundred.
class MeshCollector : public SolverMonitor {
 public:
  explicit MeshCollector(int wanted) : most_(std::max(4 * wanted, 256)) {}

  bool on_iteration(const IterationRecord&, const Coordinates& x) override {
    if (seen_++ % stride_ == 0 && (meshes_.empty() || !(meshes_.back() == x))) meshes_.push_back(x);
    if (static_cast<int>(meshes_.size()) > most_) {
      for (std::size_t k = 0; 2 * k < meshes_.size(); ++k) meshes_[k] = meshes_[2 * k];
      meshes_.resize((meshes_.size() + 1) / 2);
      stride_ *= 2;
    }
    return !InterruptGuard::requested();
  }

  const std::vector<Coordinates>& meshes() const { return meshes_; }

 private:
  int most_;
  int stride_ = 1, seen_ = 0;
  std::vector<Coordinates> meshes_;
};

}  // namespace

std::vector<Coordinates> motion_frames(const std::vector<Command>& commands, MeshState state,
                                       int per_command) {
  const InterruptGuard interrupts;
  std::vector<Coordinates> frames{state.mesh.coordinates};
  for (const Command& command : commands) {
    MeshCollector collector(per_command);
    RunOptions options;
    options.monitor = &collector;
    state = execute(command, state, options).state;
    const auto& meshes = collector.meshes();
    const int between = std::min(per_command - 1, static_cast<int>(meshes.size()));
    for (int k = 1; k <= between; ++k) {
      const auto at =
          static_cast<std::size_t>(k) * meshes.size() / (static_cast<std::size_t>(between) + 1);
      if (!(meshes[at] == frames.back())) frames.push_back(meshes[at]);
    }
    if (!(state.mesh.coordinates == frames.back())) frames.push_back(state.mesh.coordinates);
  }
  return frames;
}

}  // namespace winslow::app
