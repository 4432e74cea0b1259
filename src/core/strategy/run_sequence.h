#pragma once

#include "core/layers/layer_stack.h"
#include "core/motion/motion.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Appends the result of another run of a command: counts and histories add up, the rest is that of
/// the last run.
void append(SmoothResult& all, SmoothResult more);

/// Passes iterations on to another monitor, numbered consecutively over several runs. While only
/// the mesh outside the layers is smoothed, it adds the layers' nodes to the coordinates.
class RelayMonitor final : public SolverMonitor {
 public:
  explicit RelayMonitor(SolverMonitor* monitor) : monitor_(monitor) {}

  /// first: iterations of earlier runs. fill: layers whose inner nodes are interpolated between
  /// their walls and rims; null: none.
  void begin(int first, const LayerStack* fill);
  void on_topology(const std::shared_ptr<const Topology>& topology) override;
  bool on_iteration(const IterationRecord& record, const Coordinates& x) override;
  bool cancelled() override { return monitor_ && monitor_->cancelled(); }

 private:
  SolverMonitor* monitor_;
  int first_ = 0;
  const LayerStack* fill_ = nullptr;
};

/// The smoothing runs of one command on a mesh with layers. Their counts and histories add up in
/// one result; its outcome is that of the last run.
class RunSequence {
 public:
  /// result must outlive this object.
  RunSequence(const RunOptions& run, SmoothResult& result);

  /// Tells the monitor that later iterations are of this mesh.
  void show(const std::shared_ptr<const Topology>& topology) { relay_.on_topology(topology); }
  /// Smooths the interior; x as of smooth_interior().
  SmoothResult smooth(const MeshState& state, const SmoothOptions& smooth, Coordinates& x);
  /// Moves the rims of layers in a mesh of the elements outside. Returns the share of the motion
  /// reached.
  double open(const MeshState& outside, const LayerStack& stack, const Motion& motion,
              const SmoothOptions& smooth, Coordinates& x);
  /// Moves the boundary; x as of smooth_motion(). start: as of RunOptions.
  void move(const MeshState& state, const Motion& motion, const MotionOptions& how,
            const SmoothOptions& smooth, const Coordinates* start, Coordinates& x);
  /// Nodes that no run moves, ascending.
  std::span<const Index> kept() const {
    return options_.kept ? std::span<const Index>(*options_.kept) : std::span<const Index>();
  }
  /// Discards the last run and takes the outcome of an earlier one.
  void fall_back_to(const SmoothResult& run);

 private:
  RelayMonitor relay_;
  RunOptions options_;
  SmoothResult& result_;
};

}  // namespace winslow
