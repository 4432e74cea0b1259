#include "core/motion/transfer.h"
#include "core/strategy/newton_run.h"

namespace winslow {

bool NewtonRun::follow_boundary(const Coordinates& target, Coordinates& x) {
  constexpr double near = 0.1;  // scaled residual, with the boundary where it is
  SteadySolver& solver = newton();
  if (solver.start(x).residual > near) return false;
  Coordinates way = target;
  for (std::size_t i = 0; i < way.values().size(); ++i) way.values()[i] -= x.values()[i];
  const SmoothingProblem& problem = solver.problem();
  std::vector<double> rates(problem.unknowns());
  const int before = solver.linear_solves();
  solver.predict_and_correct(x, way, rates);
  recorder_.result().linear_solves += solver.linear_solves() - before;
  problem.advance(rates, 1, x);
  const NodeClasses& classes = workspace_.classes();
  for (Index node = 0; node < x.size(); ++node)
    if (!classes.moves(node)) x.copy_node(node, target);
  return true;
}

bool NewtonRun::converge_near(Coordinates& x) {
  constexpr int limit = 6;
  constexpr double near = 0.1, short_step = 0.25;  // scaled residual; share of a whole step
  recorder_.iterate(newton(), x, Stage::newton, 1, limit, [](const IterationRecord& record) {
    return record.residual > near || record.damping < short_step;
  });
  recorder_.result().linear_solver = linear().description();
  return recorder_.result().converged;
}

/// Predicts the result of a motion from known meshes.
class NewtonRun::Prediction {
 public:
  /// target: any mesh with the boundary at the end of the motion.
  Prediction(const Coordinates& target, const RunOptions& run, NewtonRun& steps)
      : target_(target),
        steps_(steps),
        workspace_(steps.workspace()),
        classes_(workspace_.classes()) {
    for (Index node = 0; node < target.size(); ++node)
      if (!classes_.moves(node)) nodes_.push_back(node);
    std::vector<const Coordinates*> known{run.start};
    for (const auto& mesh : run.near.earlier)
      if (leads_to(*mesh, *run.start)) known.push_back(mesh.get());
    known_ = nearest_meshes(known, nodes_, target, most_combined);
  }

  /// Converges from the prediction. False: there is none that is valid and near the result.
  bool converge(Coordinates& x) const {
    for (std::size_t count = known_.size(); count > 0; --count) {
      const auto mesh = extrapolated(std::span(known_).first(count), nodes_, target_);
      if (!mesh) continue;
      Coordinates near = unknowns_within(classes_, *mesh, target_);
      slide_back(near);
      if (!is_sound(near)) continue;
      if (!steps_.converge_near(near)) break;
      x = std::move(near);
      return true;
    }
    Coordinates near = *known_.front();
    if (!is_sound(near) || !steps_.follow_boundary(target_, near)) return false;
    slide_back(near);
    if (!is_sound(near) || !steps_.converge_near(near)) return false;
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
  NewtonRun& steps_;
  SmoothingWorkspace& workspace_;
  const NodeClasses& classes_;
  std::vector<Index> nodes_;               // without unknowns
  std::vector<const Coordinates*> known_;  // the nearest first
};

namespace {

/// Whether the energy of a run does not depend on the way to the mesh, as it does where the knee of
/// its penalty is raised on the way (VariationalRun::relax()).
bool depends_on_end_alone(const SmoothOptions& options) {
  return options.formulation == Formulation::variational && options.targets.keep > 0;
}

}  // namespace

bool NewtonRun::start_near(const Motion& motion, const RunOptions& run, Coordinates& x) {
  const Coordinates& start = *run.start;
  const NodeClasses& classes = workspace_.classes();
  Coordinates target = state_.mesh.coordinates;
  motion.apply(state_.mesh.coordinates, 1, target);
  if (depends_on_end_alone(workspace_.options()) && Prediction(target, run, *this).converge(x))
    return true;
  if (run.near.only_near) return false;
  const auto valid = [&](const Coordinates& mesh) {
    return workspace_.validity(mesh).inverted == 0;
  };
  if (valid(start)) {
    x = start;
    const auto way = run.near.way.empty()
                         ? nullptr
                         : make_motion(*state_.mesh.topology, start, std::span(run.near.way));
    const auto transfer =
        way ? make_transfer(classes, start, target, *way) : make_transfer(classes, start, target);
    if (transfer->nodes().empty())  // the boundary is there already
      smooth(x, 1, nullptr);
    else
      move(*transfer, start, 0, x);
    return true;
  }
  Coordinates within = unknowns_within(classes, start, target);
  if (!valid(within)) return false;
  x = std::move(within);
  smooth(x, 1, nullptr);
  return true;
}

}  // namespace winslow
