#include "core/command/variational_run.h"

#include <algorithm>

#include "core/outer/energy_untangler.h"
#include "core/outer/path_follower.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

/// Scaled residual at which a mesh is near enough to its solution to follow the path from there.
constexpr double near_enough = 0.05;

/// Stops a fixed-point iteration that no longer untangles anything.
class Stagnation {
 public:
  bool operator()(const IterationRecord& record) {
    constexpr int patience = 25;
    constexpr double settled = 1e-4;
    if (record.inverted == 0) return true;
    if (record.iteration == 0 || record.inverted < least_) {
      least_ = record.inverted;
      since_ = 0;
    } else {
      ++since_;
    }
    return since_ >= patience || record.residual < settled;
  }

 private:
  Index least_ = 0;
  int since_ = 0;
};

}  // namespace

bool VariationalRun::untangle_by_picard(Coordinates& x, double fraction) {
  constexpr int limit = 150;
  return recorder_.iterate(workspace_.picard(), x, Stage::picard, fraction, limit, Stagnation())
             .inverted == 0;
}

bool VariationalRun::untangle_by_energy(Coordinates& x, double fraction,
                                        const Coordinates* reference) {
  constexpr int limit = 200;
  // Winslow's own functional: without a barrier, a steep penalty would only stiffen the system.
  workspace_.energy().set_penalty({1, 0});
  EnergyUntangler untangler(*state_.mesh.topology, workspace_.energy(),
                            workspace_.symmetric_linear(), workspace_.options(), reference);
  recorder_.iterate(untangler, x, Stage::untangle, fraction, limit);
  workspace_.energy().set_penalty(workspace_.options().penalty);
  return untangler.converged();
}

bool VariationalRun::untangle(Coordinates& x, double fraction, const Coordinates* reference) {
  const Topology& topology = *state_.mesh.topology;
  const int threads = workspace_.options().threads;
  if (check_validity(topology, x, threads).inverted == 0) return true;
  const Untangle how = workspace_.options().untangle;
  const Coordinates start = x;
  if (how != Untangle::energy && untangle_by_picard(x, fraction)) return true;
  if (how == Untangle::picard) return false;
  if (untangle_by_energy(x, fraction, reference)) return true;
  if (how == Untangle::energy) return false;
  // Where the fixed point leads astray, the energy alone may do better from the start itself.
  Coordinates other = start;
  if (!untangle_by_energy(other, fraction, reference)) {
    recorder_.result().inverted = check_validity(topology, x, threads).inverted;
    return false;
  }
  x = std::move(other);
  return true;
}

/// Far from a solution the steep penalty makes Newton's method creep: a gentle one first.
void VariationalRun::relax(Coordinates& x, double fraction) {
  constexpr double far = 1.5;  // knees
  constexpr int limit = 40;
  const PenaltyOptions& penalty = workspace_.options().penalty;
  const double knee = penalty.knee > 0 ? penalty.knee : 2;
  if (penalty.exponent <= 2 || workspace_.energy().worst_distortion(x) < far * knee) return;
  workspace_.energy().set_penalty({2, 0});
  workspace_.newton().forget_factorisation();
  recorder_.iterate(workspace_.newton(), x, Stage::relax, fraction, limit,
                    [](const IterationRecord& record) { return record.residual < near_enough; });
  workspace_.energy().set_penalty(penalty);
}

void VariationalRun::approach(Coordinates& x, double fraction) {
  constexpr int limit = 30;
  relax(x, fraction);
  recorder_.iterate(workspace_.newton(), x, Stage::relax, fraction, limit,
                    [](const IterationRecord& record) { return record.residual < near_enough; });
}

void VariationalRun::converge(Coordinates& x, double fraction) {
  relax(x, fraction);
  recorder_.iterate(workspace_.newton(), x, Stage::newton, fraction);
  recorder_.result().linear_solver = workspace_.symmetric_linear().description();
}

void VariationalRun::smooth(Coordinates& x, double fraction, const Coordinates* reference) {
  if (untangle(x, fraction, reference)) {
    converge(x, fraction);
  } else {
    recorder_.result().converged = false;
  }
}

void VariationalRun::follow(const Motion& motion, const Coordinates& rest, Coordinates& x) {
  if (!untangle(x, 0, nullptr)) {
    recorder_.result().converged = false;
    return;
  }
  approach(x, 0);
  EnergyNewton& newton = workspace_.newton();
  const auto accept = [&](const IterationRecord& record, const Coordinates& at) {
    recorder_.report(record, at, Stage::path, record.fraction, true);
    return recorder_.remaining() > 0;
  };
  // Where the path is lost, the way back to it is Newton's method with the boundary held; then it
  // goes on from there. Only where that gains nothing, twice, is the motion blocked.
  constexpr double worthwhile = 1e-5;
  PathOptions options;
  double reached = 0;
  for (int failures = 0; reached < 1 && failures < 2 && recorder_.remaining() > 0;) {
    const int before = newton.linear_solves();
    const double last = reached;
    reached = PathFollower(*state_.mesh.topology, newton, options)
                  .follow(motion, rest, reached, x, accept);
    recorder_.result().linear_solves += newton.linear_solves() - before;
    if (reached >= 1) break;
    failures = reached - last > worthwhile ? 0 : failures + 1;
    converge(x, reached);
    options.first_step = std::min(0.02, 0.5 * (1 - reached));
    options.greedy = failures > 0;
  }
  if (reached >= 1) converge(x, reached);
}

void VariationalRun::move_in_steps(const Motion& motion, const Coordinates& rest, int increments,
                                   Coordinates& x) {
  recorder_.result().increments = increments;
  for (int k = 1; k <= increments; ++k) {
    const double fraction = static_cast<double>(k) / increments;
    motion.apply(rest, fraction, x);
    if (!untangle(x, fraction, &rest)) {
      if (k < increments) continue;
      recorder_.result().converged = false;
      return;
    }
    if (k < increments) approach(x, fraction);
  }
  converge(x, 1);
}

}  // namespace winslow
