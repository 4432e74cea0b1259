#include "core/strategy/held_walls.h"

#include "core/error.h"
#include "core/formulation/wall_stretch.h"
#include "core/quality/quality.h"
#include "core/strategy/run_sequence.h"
#include "core/strategy/smooth_run.h"

namespace winslow {

namespace {

/// The heights of the layers at the held walls, over those in the reference mesh.
class HeldHeights {
 public:
  explicit HeldHeights(const MeshState& state)
      : reference_(reference_of(state)),
        edges_(layer_edges({state.mesh.topology, *reference_},
                           state.mesh.topology->markers().nodes_of(state.held_walls))),
        factors_(at(state.mesh.topology->node_count()), 0.0) {
    for (const LayerEdge& edge : edges_) factors_[at(edge.upper)] = 1;
  }

  const std::vector<double>& factors() const { return factors_; }
  double error(const Coordinates& x) const {
    double largest = 0;
    for (const LayerEdge& edge : edges_) largest = std::max(largest, std::abs(ratio(edge, x) - 1));
    return largest;
  }
  void correct(const Coordinates& x) {
    constexpr double most = 2;  // in one round
    for (const LayerEdge& edge : edges_)
      factors_[at(edge.upper)] *= std::clamp(1 / ratio(edge, x), 1 / most, most);
  }
  /// Returns to earlier factors().
  void restore(const std::vector<double>& factors) { factors_ = factors; }
  LayersHeld report(const Coordinates& x) const {
    return {static_cast<Index>(edges_.size()), error(x), factors_};
  }

 private:
  static double length(const LayerEdge& edge, const Coordinates& x) {
    return (place_of(x, edge.upper) - place_of(x, edge.lower)).norm();
  }
  double ratio(const LayerEdge& edge, const Coordinates& x) const {
    return length(edge, x) / length(edge, *reference_);
  }

  std::shared_ptr<const Coordinates> reference_;
  std::vector<LayerEdge> edges_;
  std::vector<double> factors_;  // #nodes
};

/// Corrects the heights of layers in x, the result of a motion with stiff layers. run: has the
/// factors of these heights.
void correct_heights(const MeshState& state, const Motion& motion, const SmoothOptions& smooth,
                     const RunOptions& run, HeldHeights& heights, SmoothResult& result,
                     Coordinates& x) {
  constexpr int rounds = 6;
  constexpr double tolerance = 5e-3, worth_keeping = 0.9;
  const auto smallest_sine = [&](const Coordinates& mesh) {
    return check_validity(*state.mesh.topology, mesh, smooth.threads).min_sine;
  };
  const double least_sine = worth_keeping * smallest_sine(x);
  double error = heights.error(x);
  for (int round = 0; round < rounds && error > tolerance; ++round) {
    const std::vector<double> uncorrected = heights.factors();
    heights.correct(x);
    RunSequence runs(run, result);
    const SmoothResult before = result;
    Coordinates corrected = x;
    runs.move(state, motion, {}, smooth, &x, corrected);
    const double now = heights.error(corrected);
    const bool good = result.converged && result.inverted == 0 && result.fraction_reached >= 1 &&
                      now < error && smallest_sine(corrected) >= least_sine;
    if (!good) {
      runs.fall_back_to(before);
      heights.restore(uncorrected);
      break;
    }
    const bool worthwhile = now < 0.9 * error;
    x = std::move(corrected);
    error = now;
    if (!worthwhile) break;
  }
}

}  // namespace

void hold_walls(std::span<const LayerWall> walls, MeshState& state) {
  const Markers& markers = state.mesh.topology->markers();
  for (const LayerWall& wall : walls) {
    const auto nodes = markers.nodes_of(wall.markers);
    if (layer_edges(state.mesh, nodes).empty()) {
      std::string names;
      for (const std::string& name : wall.markers) names += (names.empty() ? "" : ", ") + name;
      throw UsageError("there are no layers at " + names +
                       ": no elements that are 1.65 times as long along the wall as high");
    }
    for (const std::string& name : wall.markers)
      if (std::ranges::find(state.held_walls, name) == state.held_walls.end())
        state.held_walls.push_back(name);
  }
}

SmoothResult move_with_held_walls(MeshState& state, const Motion& motion, const MotionOptions& how,
                                  const SmoothOptions& asked, const RunOptions& run) {
  SmoothOptions smooth = asked;
  smooth.targets = smooth.targets.or_else(TargetBlend::keeping());
  if (smooth.targets.keep == 0)
    throw UsageError(
        "hold-layers: in a volume mesh only the targets keep hold heights: expected these, or no "
        "targets");
  HeldHeights heights(state);
  RunOptions own = run;
  own.layer_factors = &heights.factors();
  SmoothResult result;
  RunSequence runs(own, result);
  Coordinates x = starting_point(state, run);
  runs.move(state, motion, how, smooth, run.start, x);
  if (result.converged && result.inverted == 0 && result.fraction_reached >= 1) {
    const Coordinates moved = x;
    const SmoothResult before = result;
    const std::vector<double> uncorrected = heights.factors();
    correct_heights(state, motion, smooth, own, heights, result, x);
    // Better heights do not justify a mesh outside the limits.
    if (how.floor.given() &&
        !how.floor.fault({state.mesh.topology, x}, state.mesh.coordinates).empty()) {
      runs.fall_back_to(before);
      heights.restore(uncorrected);
      x = moved;
    }
  }
  result.layers_held = heights.report(x);
  state.mesh.coordinates = std::move(x);
  return result;
}

}  // namespace winslow
