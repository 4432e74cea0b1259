#include "core/strategy/newton_run.h"

#include "core/error.h"
#include "core/quality/quality.h"
#include "core/strategy/sliding.h"

namespace winslow {

namespace {

/// Whether an outer iteration had its step cut very short.
bool creeps(const IterationRecord& record) {
  constexpr double short_step = 0.1;
  return record.iteration > 0 && record.damping < short_step;
}

}  // namespace

bool NewtonRun::untangle(Coordinates& x, double fraction, const Coordinates* reference) {
  Untangling untangling(state_, workspace_, recorder_);
  const bool valid = untangling.run(x, fraction, reference);
  const bool other_cells = valid && workspace_.drop_guards_broken_at(x);
  const bool other_vcvs = valid && workspace_.adjust_tangled_vcvs(x);
  if (untangling.tried_energy() || other_cells || other_vcvs) begin_anew();
  if (valid) return true;
  recorder_.result().converged = false;
  return false;
}

/// Returns false if Newton's steps are cut so short that very many would be needed, and there is
/// another method: single elements far from their targets prevent longer steps, and larger meshes
/// have more of them.
bool NewtonRun::approach(Coordinates& x, double fraction) {
  constexpr int limit = 30;
  bool creeping = false;
  const auto enough = [&](const IterationRecord& record) {
    creeping = has_targets() && creeps(record);
    return creeping || near_enough(record);
  };
  relax(x, fraction, enough);
  if (!creeping) recorder_.iterate(newton(), x, Stage::relax, fraction, limit, enough);
  return !creeping;
}

/// Resets x to `start`, which is the solution for its own shapes.
void NewtonRun::begin_with_own_shapes(const Coordinates& start, Coordinates& x) {
  x = start;
  begin_anew();
  vary_targets(x);
}

void NewtonRun::relax_along_targets(Coordinates& x, double fraction) {
  Path path([](double, Coordinates&) {});
  path.change_problem = [this](double share) { set_target_share(share); };
  const auto accept = [&](const IterationRecord& record, const Coordinates& mesh) {
    recorder_.report(record, mesh, Stage::relax, fraction, true);
    return recorder_.remaining() > 0;
  };
  const int before = newton().linear_solves();
  PathFollower(newton(), {}).follow(path, 0, x, accept);
  recorder_.result().linear_solves += newton().linear_solves() - before;
  set_target_share(1);
}

/// at_any_pace: if false, returns false when Newton's method makes only very short steps (see
/// approach).
bool NewtonRun::converge(Coordinates& x, double fraction, bool at_any_pace) {
  bool creeping = false;
  const auto too_slow = [&](const IterationRecord& record) {
    creeping = !at_any_pace && has_targets() && creeps(record);
    return creeping;
  };
  constexpr int most_first_order_steps = 600;
  const bool is_near = descend(x, fraction, most_first_order_steps, {});
  if (is_near && recorder_.result().converged) return true;
  const auto enough = [&](const IterationRecord& record) {
    return too_slow(record) || near_enough(record);
  };
  if (!is_near) relax(x, fraction, enough);
  if (!creeping) recorder_.iterate(newton(), x, Stage::newton, fraction, too_slow);
  if (creeping) return false;
  while (recorder_.result().converged && sharpen(x)) {
    const Coordinates solution = x;
    const RunOutcome outcome = recorder_.result();
    recorder_.iterate(newton(), x, Stage::newton, fraction);
    if (recorder_.result().converged) continue;
    x = solution;
    recorder_.restore_outcome(outcome);
  }
  recorder_.result().linear_solver = linear().description();
  return true;
}

void NewtonRun::smooth(Coordinates& x, double fraction, const Coordinates* reference) {
  if (!untangle(x, fraction, reference)) return;
  const Coordinates start = x;
  if (converge(x, fraction, false)) return;
  begin_with_own_shapes(start, x);
  relax_along_targets(x, fraction);
  converge(x, fraction);
}

/// Returns to the solution, near enough to follow the path from there. Returns false if it is not
/// found.
bool NewtonRun::settle(Coordinates& x, double fraction) {
  constexpr int limit = 25;
  constexpr double settled = 1e-4;
  relax(x, fraction, near_enough);
  const IterationRecord last =
      recorder_.iterate(newton(), x, Stage::newton, fraction, limit,
                        [](const IterationRecord& record) { return record.residual < settled; });
  return last.residual < settled;
}

/// The quality limit that a mesh violates; empty: none.
std::string NewtonRun::fault(const Coordinates& x) const {
  return floor_.given() ? floor_.fault({state_.mesh.topology, x}, state_.mesh.coordinates)
                        : std::string();
}

std::vector<Index> NewtonRun::yielding_nodes() const {
  return winslow::yielding_nodes(recorder_.result().boundary, workspace_.classes());
}

double NewtonRun::smallest_sine(const Coordinates& x) const {
  return workspace_.validity(x).min_sine;
}

/// Converges at the end of a path. Meshes of the path are only near their solutions: if such a mesh
/// is within the limits and its solution is not, the mesh is kept.
void NewtonRun::end_path(Coordinates& x, double reached) {
  Coordinates end_of_path = x;
  leave_path();
  converge(x, reached);
  const std::string broken = fault(x);
  if (broken.empty()) return;
  recorder_.result().limited_by = broken;
  x = std::move(end_of_path);
  recorder_.iterate(newton(), x, Stage::newton, reached, 0);
}

void NewtonRun::move(const Motion& motion, const Coordinates& rest, int increments,
                     Coordinates& x) {
  if (increments > 0)
    move_in_steps(motion, rest, increments, x);
  else
    move_along_path(motion, rest, x);
}

void NewtonRun::move_along_path(const Motion& motion, const Coordinates& rest, Coordinates& x) {
  const Topology& topology = *state_.mesh.topology;
  SmoothResult& result = recorder_.result();
  if (!way_is_clear_)
    result.contact = find_contact(topology, rest, motion.of_bodies(), yielding_nodes());
  if (result.contact && end_at_contact_) {
    recorder_.iterate(newton(), x, Stage::newton, 0, 0);
    result.converged = false;
    return;
  }
  if (!untangle(x, 0, nullptr)) return;
  // A blocked motion ends before the mesh degenerates into slivers.
  constexpr double worth_keeping = 0.1;
  const double given = smallest_sine(state_.mesh.coordinates);
  const double least_sine = worth_keeping * (given > 0 ? given : smallest_sine(x));
  Path path([&](double fraction, Coordinates& mesh) { motion.apply(rest, fraction, mesh); });
  const Coordinates start = x;
  double reached = carry_and_descend(motion, path, least_sine, x);
  if (reached > 0 && reached < 1) begin_path();
  if (reached < 1 && !approach(x, reached)) {
    reached = 0;
    begin_with_own_shapes(start, x);
    set_target_share(0);
    path.change_problem = [this](double share) { set_target_share(share); };
  }
  // Limits apply to solutions, so the meshes on the path must be solutions of the whole problem.
  if (!floor_.given()) begin_path();
  if (reached == 0) reached = carry_along(motion, path, x);
  follow_path(path, reached, least_sine, x);
  if (result.fraction_reached < 1 && !result.contact && result.limited_by.empty())
    result.gap = smallest_gap(topology, x, motion.of_bodies(), yielding_nodes());
}

namespace {

constexpr int patience_on_path = 4;  // short steps

/// Options for the next part of a path, which begins at a settled mesh. last, reached: the
/// fractions of the motion between which the part before went; failed: it gained next to nothing.
void go_on_from(double last, double reached, bool failed, PathOptions& options) {
  options.first_step = std::min(0.02, 0.5 * (1 - reached));
  options.greedy = failed;
  // Settling costs as much as many short steps: it has to pay, and meshes stay nearer to the path
  // from then on.
  constexpr double worth_settling = 0.1, near = 0.02;
  if (options.patience > 0) options.loose_tolerance = std::min(options.loose_tolerance, near);
  options.patience = reached - last > worth_settling ? patience_on_path : 4 * options.patience;
}

}  // namespace

/// Carries a mesh at one fraction of a motion to another, the boundary and all other nodes.
Coordinates NewtonRun::carried(const Twist& twist, const Path& path, const Coordinates& x,
                               double from, double to) {
  Coordinates out = x;
  path.move(to, out);
  twist.carry(from, to, out);
  const SmoothingProblem& problem = newton().problem();
  problem.advance(std::vector<double>(problem.unknowns()), 1, out);  // back onto curves, surfaces
  return out;
}

/// Takes one step of Newton's method, and adds it to the solves of the run. Returns its record;
/// none if the step was cut very short, and x is as before.
std::optional<IterationRecord> NewtonRun::correct(Coordinates& x) {
  SteadySolver& solver = newton();
  const int before = solver.linear_solves();
  solver.start(x);
  Coordinates corrected = x;
  const IterationRecord record = solver.step(corrected);
  recorder_.result().linear_solves += solver.linear_solves() - before;
  if (creeps(record)) {
    solver.reject();
    return std::nullopt;
  }
  x = std::move(corrected);
  return record;
}

namespace {

/// Whether many elements are stretched, as in layers.
bool is_layered(const Mesh& mesh) {
  constexpr double stretched = 10, many = 0.05;
  const auto conditions = element_values(mesh, Metric::condition_number);
  const auto count = std::ranges::count_if(conditions, [](double c) { return !(c < stretched); });
  return static_cast<double>(count) > many * static_cast<double>(conditions.size());
}

}  // namespace

/// Carries a whole volume mesh along with its bodies, by as much at once as leaves it valid, and
/// smooths it a little by first-order steps before the next part. These mend a sheared mesh, which
/// Newton's method does not, for a fraction of what the path costs. Layers of stretched elements
/// are better led along the path: a twist shears them. Returns the fraction of the motion reached.
///
/// least_sine: smallest normalized Jacobian of a mesh from which the path may go on.
double NewtonRun::carry_and_descend(const Motion& motion, const Path& path, double least_sine,
                                    Coordinates& x) {
  const Topology& topology = *state_.mesh.topology;
  if (topology.cell_dimension() != 3 || blocked_by_contact() || !may_carry_ || floor_.given() ||
      !descends() || is_layered(state_.mesh))
    return 0;
  const auto twist = Twist::find(workspace_.classes(), x, motion, workspace_.options().threads);
  if (!twist) return 0;
  constexpr double most_turn = 90, shortest = 1.0 / 16;  // degrees; share of that
  constexpr int few = 10, many = 20;                     // first-order steps between parts
  const double whole = 1 / std::max(1.0, std::ceil(twist->largest_turn() / most_turn));
  PathMesh good{0, x};  // the last one without slivers
  double reached = 0;
  for (double share = whole;
       reached < 1 && share >= shortest * whole && recorder_.remaining() > 0;) {
    const double to = reached + share > 1 - 0.5 * shortest * whole ? 1 : reached + share;
    Coordinates there = carried(*twist, path, x, reached, to);
    if (workspace_.validity(there).inverted > 0) {
      share *= 0.5;
      continue;
    }
    x = std::move(there);
    reached = to;
    if (reached < 1) descend(x, reached, share < whole ? many : few, near_enough);
    if (smallest_sine(x) >= least_sine) good = {reached, x};
  }
  if (reached >= 1) {
    recorder_.interior_is_behind();
    return 1;
  }
  x = std::move(good.x);
  return good.fraction;
}

/// Carries the whole mesh along with rigid bodies as far as Newton's method goes on well from
/// there: the thinnest layers follow such a body at once, on a path only in short steps. The thin
/// elements of a wake do not, and are better led along the path. In space sheared tetrahedra cost
/// Newton's method more than it saves. Returns the fraction of the motion reached.
double NewtonRun::carry_along(const Motion& motion, const Path& path, Coordinates& x) {
  const Topology& topology = *state_.mesh.topology;
  if (!on_path() || blocked_by_contact() || !may_carry_ || topology.cell_dimension() == 3) return 0;
  const auto twist = Twist::find(workspace_.classes(), x, motion, workspace_.options().threads);
  if (!twist) return 0;
  constexpr double most_turn = 45, kept_sine = 0.3;
  const double least_sine = kept_sine * smallest_sine(x);
  const double whole = 1 / std::max(1.0, std::ceil(twist->largest_turn() / most_turn));
  const double shortest = whole / 2;
  double reached = 0;
  for (double share = whole; reached < 1 && share >= shortest && recorder_.remaining() > 0;) {
    const double to = std::min(1.0, reached + share);
    Coordinates there = carried(*twist, path, x, reached, to);
    const Validity validity = workspace_.validity(there);
    if (validity.inverted > 0 || validity.min_sine < least_sine) {
      share *= 0.5;
      continue;
    }
    const auto record = correct(there);
    if (!record) return reached;
    x = std::move(there);
    reached = to;
    recorder_.report(*record, x, Stage::path, reached, true);
  }
  return reached;
}

/// reached: the fraction of the motion at x. least_sine: smallest normalized Jacobian at which a
/// blocked motion may end.
void NewtonRun::follow_path(const Path& path, double reached, double least_sine, Coordinates& x) {
  SteadySolver& solver = newton();
  PathMesh good{reached, x};  // the last one without slivers
  double min_sine = 1;
  const auto accept = [&](const IterationRecord& record, const Coordinates& mesh) {
    recorder_.report(record, mesh, Stage::path, record.fraction, true);
    min_sine = record.min_sine;
    if (min_sine >= least_sine) good = {record.fraction, mesh};
    return recorder_.remaining() > 0 && !strained(mesh);
  };
  std::string& limit =
      recorder_.result().limited_by;  // violated between the last mesh and the next
  bool ended = false;                 // because the next mesh violates a limit
  const auto within_limits = [&](const Coordinates& mesh) {
    limit = fault(mesh);
    ended = !limit.empty() || (blocked_by_contact() && smallest_sine(mesh) < least_sine);
    return !ended;
  };
  // If the path is lost, Newton's method with the boundary held leads back to it, and the path
  // continues from there. The motion counts as blocked if this has no gain twice in a row. A mesh
  // compressed against a wall gains less each time, so a larger gain is required there.
  const double pressed = 0.25 * least_sine;
  constexpr double worthwhile = 1e-5, worthwhile_pressed = 5e-3;
  PathOptions options;
  options.admits = within_limits;
  // Limits apply to solutions, so the meshes on the path must be close to solutions.
  if (floor_.given()) options.loose_tolerance = 1e-3;
  if (on_path()) options.patience = patience_on_path;
  within_limits(x);
  for (int failures = 0; !ended && reached < 1 && failures < 2 && recorder_.remaining() > 0;) {
    const int before = solver.linear_solves();
    const double last = reached;
    reached = PathFollower(solver, options).follow(path, reached, x, accept);
    recorder_.result().linear_solves += solver.linear_solves() - before;
    if (reached >= 1 || ended) break;
    const double least = min_sine < pressed ? worthwhile_pressed : worthwhile;
    failures = reached - last > least ? 0 : failures + 1;
    Coordinates end_of_path = x;
    if (!settle(x, reached) && !insists()) {
      x = std::move(end_of_path);
      recorder_.iterate(solver, x, Stage::newton, reached, 0);
      break;
    }
    if (!within_limits(x)) {
      x = std::move(end_of_path);
      break;
    }
    go_on_from(last, reached, failures > 0, options);
    if (!on_path()) options.patience = 0;
  }
  if (reached < 1 && limit.empty() && smallest_sine(x) < least_sine) {
    ended = true;
    go_back(path, good, reached, x);
  }
  recorder_.result().linear_solver = linear().description();
  if (reached >= 1 || ended || on_path()) end_path(x, reached);
}

/// Returns to an earlier mesh of the path.
void NewtonRun::go_back(const Path& path, PathMesh& earlier, double& reached, Coordinates& x) {
  reached = earlier.fraction;
  x = std::move(earlier.x);
  if (path.change_problem) path.change_problem(reached);
}

void NewtonRun::move_in_steps(const Motion& motion, const Coordinates& rest, int increments,
                              Coordinates& x) {
  recorder_.result().increments = increments;
  for (int k = 1; k <= increments; ++k) {
    const double fraction = static_cast<double>(k) / increments;
    motion.apply(rest, fraction, x);
    if (!untangle(x, fraction, &rest)) {
      if (k < increments) continue;
      return;
    }
    if (k < increments) approach(x, fraction);
  }
  recorder_.interior_is_behind();
  converge(x, 1);
}

}  // namespace winslow
