#include "core/strategy/near_start.h"

#include "core/motion/transfer.h"

namespace winslow {

namespace {

/// Predicts the result of a motion from known meshes.
class Prediction {
 public:
  /// target: any mesh with the boundary at the end of the motion.
  Prediction(const Coordinates& target, const RunOptions& run, SmoothingWorkspace& workspace)
      : target_(target), workspace_(workspace), classes_(workspace.classes()) {
    for (Index node = 0; node < target.size(); ++node)
      if (!classes_.moves(node)) nodes_.push_back(node);
    std::vector<const Coordinates*> known{run.start};
    for (const auto& mesh : run.near.earlier)
      if (leads_to(*mesh, *run.start)) known.push_back(mesh.get());
    known_ = nearest_meshes(known, nodes_, target, most_combined);
  }

  /// Converges from the prediction. False: there is none that is valid and near the result.
  bool converge(NewtonRun& steps, Coordinates& x) const {
    for (std::size_t count = known_.size(); count > 0; --count) {
      const auto mesh = extrapolated(std::span(known_).first(count), nodes_, target_);
      if (!mesh) continue;
      Coordinates near = unknowns_within(classes_, *mesh, target_);
      slide_back(near);
      if (!is_sound(near)) continue;
      if (!steps.converge_near(near)) break;
      x = std::move(near);
      return true;
    }
    Coordinates near = *known_.front();
    if (!is_sound(near) || !steps.follow_boundary(target_, near)) return false;
    slide_back(near);
    if (!is_sound(near) || !steps.converge_near(near)) return false;
    x = std::move(near);
    return true;
  }

 private:
  static constexpr std::size_t most_combined = 4;

  /// Whether a mesh may be combined with the last one. After a full turn of a body its boundary is
  /// where it was and its interior is not: it differs by more than the boundaries do.
  bool leads_to(const Coordinates& mesh, const Coordinates& last) const {
    constexpr double most = 2;  // times the largest way of the boundary
    double boundary = 0, all = 0;
    for (const Index node : nodes_)
      boundary = std::max(boundary, (place_of(mesh, node) - place_of(last, node)).norm());
    for (Index node = 0; node < last.size(); ++node)
      all = std::max(all, (place_of(mesh, node) - place_of(last, node)).norm());
    return all <= most * boundary;
  }
  /// Puts nodes that slide on what they slide on.
  void slide_back(Coordinates& x) const {
    const auto energy = workspace_.energy();
    energy->advance(std::vector<double>(energy->unknowns(), 0.0), 0, x);
  }
  bool is_sound(const Coordinates& x) const {
    return workspace_.validity(x).inverted == 0 && std::isfinite(workspace_.energy()->energy(x));
  }

  const Coordinates& target_;
  SmoothingWorkspace& workspace_;
  const NodeClasses& classes_;
  std::vector<Index> nodes_;               // without unknowns
  std::vector<const Coordinates*> known_;  // the nearest first
};

/// Whether the energy of a run does not depend on the way to the mesh, as it does where the knee of
/// its penalty is raised on the way (VariationalRun::relax()).
bool depends_on_end_alone(const SmoothOptions& options) {
  return options.formulation == Formulation::variational && options.targets.keep > 0;
}

}  // namespace

bool start_near(const MeshState& state, const Motion& motion, const RunOptions& run,
                SmoothingWorkspace& workspace, NewtonRun& steps, Coordinates& x) {
  const Coordinates& start = *run.start;
  const NodeClasses& classes = workspace.classes();
  Coordinates target = state.mesh.coordinates;
  motion.apply(state.mesh.coordinates, 1, target);
  if (depends_on_end_alone(workspace.options()) &&
      Prediction(target, run, workspace).converge(steps, x))
    return true;
  if (run.near.only_near) return false;
  const auto valid = [&](const Coordinates& mesh) {
    return workspace.validity(mesh).inverted == 0;
  };
  if (valid(start)) {
    x = start;
    const auto way = run.near.way.empty()
                         ? nullptr
                         : make_motion(*state.mesh.topology, start, std::span(run.near.way));
    const auto transfer =
        way ? make_transfer(classes, start, target, *way) : make_transfer(classes, start, target);
    if (transfer->nodes().empty())  // the boundary is there already
      steps.smooth(x, 1, nullptr);
    else
      steps.move(*transfer, start, 0, x);
    return true;
  }
  Coordinates within = unknowns_within(classes, start, target);
  if (!valid(within)) return false;
  x = std::move(within);
  steps.smooth(x, 1, nullptr);
  return true;
}

}  // namespace winslow
