#include "core/strategy/untangling.h"

#include "core/quality/volume_element.h"

namespace winslow {

namespace {

/// Stops an iteration that no longer untangles the mesh. A boundary moved in one step inverts few
/// elements at first, then the number grows: the count is meaningful only later.
class Stagnation {
 public:
  /// settled: residual below which the mesh hardly changes any more.
  explicit Stagnation(double settled = 0) : settled_(settled) {}
  bool operator()(const IterationRecord& record) {
    constexpr std::size_t window = 40;
    constexpr double worthwhile = 0.8;  // of the count a window ago
    if (record.inverted == 0) return true;
    counts_.push_back(record.inverted);
    if (record.residual < settled_) return true;
    return counts_.size() > 2 * window &&
           counts_.back() > worthwhile * counts_[counts_.size() - 1 - window];
  }

 private:
  double settled_;
  std::vector<Index> counts_;
};

}  // namespace

bool Untangling::by_picard(Coordinates& x, double fraction) {
  constexpr int limit = 150;
  constexpr double settled = 1e-4;
  return recorder_
             .iterate(workspace_.picard(), x, Stage::picard, fraction, limit, Stagnation(settled))
             .inverted == 0;
}

bool Untangling::by_energy(Coordinates& x, double fraction, const Coordinates* reference,
                           Interior interior, const RunRecorder::Enough& enough) {
  constexpr int limit = 200;
  tried_energy_ = true;
  for (;; interior = Interior::as_given) {
    // Uses Winslow's own functional: without a barrier, a steep penalty would only make the system
    // stiff.
    EnergyUntangler untangler(workspace_.energy()->with_penalty({1, 0}),
                              workspace_.symmetric_linear(), workspace_.options().linear.tolerance,
                              reference, interior);
    const RunRecorder::Enough from_here = enough;  // a copy, since it may have internal state
    recorder_.iterate(untangler, x, Stage::untangle, fraction, limit, from_here);
    if (untangler.converged()) return true;
    if (!guard_inside(x)) return false;
  }
}

/// An energy over corners does not detect elements that are inverted only between them. Returns
/// whether there are such elements that were not guarded yet.
bool Untangling::guard_inside(const Coordinates& x) {
  const Topology& topology = *state_.mesh.topology;
  if (topology.cell_dimension() < 3) return false;
  std::vector<Index> inside;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const VolumeElement element(x, topology.shape(e), topology.element(e));
    if (element.scaled_jacobian() > 0 && element.inverted()) inside.push_back(e);
  }
  return workspace_.guard(inside);
}

/// Begins with the harmonic interior, if that has fewer inverted elements than the mesh. The
/// interior of a scramble is worthless, and the energy would contract its nodes where they are.
bool Untangling::by_harmonic_start(Coordinates& x, double fraction) {
  constexpr int limit = 60;  // later success is unlikely
  const Index given = workspace_.validity(x).inverted;
  const auto hopeless = [given](const IterationRecord& record) {
    return record.iteration > limit || (record.iteration == 1 && record.inverted >= given);
  };
  Coordinates harmonic = x;
  if (!by_energy(harmonic, fraction, nullptr, Interior::harmonic, hopeless)) return false;
  x = std::move(harmonic);
  return true;
}

/// Tries both starts, each to the end. If both fail, the result is the mesh with fewer inverted
/// elements.
bool Untangling::by_energy_from_either(Coordinates& x, double fraction,
                                       const Coordinates* reference) {
  const Coordinates start = x;
  if (by_energy(x, fraction, reference, Interior::as_given, Stagnation())) return true;
  Coordinates other = start;
  if (by_energy(other, fraction, reference, Interior::harmonic)) {
    x = std::move(other);
    return true;
  }
  const auto inverted = [&](const Coordinates& mesh) { return workspace_.validity(mesh).inverted; };
  const Index from_given = inverted(x), from_harmonic = inverted(other);
  if (from_harmonic < from_given) x = std::move(other);
  recorder_.result().inverted = std::min(from_given, from_harmonic);
  return false;
}

bool Untangling::run(Coordinates& x, double fraction, const Coordinates* reference) {
  const Topology& topology = *state_.mesh.topology;
  if (workspace_.validity(x).inverted == 0) return true;
  // In space only the energy untangles: the fixed point would use the VCVs of a tangled mesh. The
  // same holds for sliding nodes, which the fixed point does not support.
  const bool energy_alone = topology.space_dimension() == 3 || workspace_.options().slide.given();
  const Untangle chosen = workspace_.options().untangle;
  const Untangle how = chosen == Untangle::automatic && energy_alone ? Untangle::energy : chosen;
  // The fixed point is the pointwise form's own method and leads nearer to its solution.
  const bool energy_first =
      how == Untangle::energy ||
      (how == Untangle::automatic && workspace_.options().formulation == Formulation::variational);
  if (energy_first && !reference && by_harmonic_start(x, fraction)) return true;
  if (how == Untangle::energy) return by_energy_from_either(x, fraction, reference);
  const Coordinates start = x;
  if (by_picard(x, fraction)) return true;
  if (how == Untangle::picard) return false;
  if (by_energy(x, fraction, reference, Interior::as_given)) return true;
  // If the fixed point fails, the energy alone may succeed from the original start.
  Coordinates other = start;
  if (!by_energy_from_either(other, fraction, reference)) {
    recorder_.result().inverted = workspace_.validity(x).inverted;
    return false;
  }
  x = std::move(other);
  return true;
}

namespace {

/// Whether the last rounds have lowered the largest distortion enough to continue.
class Progress {
 public:
  bool worthwhile(double worst) {
    constexpr std::size_t window = 8;
    constexpr double least = 2e-3;  // of what f is above 1
    worst_.push_back(worst);
    if (worst_.size() <= window) return true;
    const double before = worst_.front();
    worst_.pop_front();
    return before - worst > least * (before - 1);
  }

 private:
  std::deque<double> worst_;
};

}  // namespace

void raise_worst_element(SmoothingWorkspace& workspace, RunRecorder& recorder, double fraction,
                         Coordinates& x, const RaiseLimits& limits) {
  constexpr int steps = 3;                  // Newton steps per round
  constexpr double closer = 0.5, away = 3;  // factors of the bound's distance, per round
  constexpr double farthest = 2;            // bound, in largest distortions
  constexpr double short_step = 0.2, settled = 1e-3;
  const RunOutcome outcome = recorder.result();
  EnergyNewton& newton = workspace.newton();
  auto energy = workspace.energy()->with_corner_lengths(x);
  double worst = energy->worst_distortion(x);
  if (!std::isfinite(worst)) return;
  Coordinates best = x;
  double best_sine = workspace.validity(x).min_sine, bound = farthest * worst;
  Progress progress;
  int round = 0;
  do {
    energy = energy->with_penalty({.exponent = 1, .knee = 0, .bound = bound});
    newton.set_problem(energy);
    bool begun = false;  // a round has at least one step
    const auto enough = [&](const IterationRecord& record) {
      return std::exchange(begun, true) && record.residual < settled;
    };
    const IterationRecord last = recorder.iterate(newton, x, Stage::worst, fraction, steps, enough);
    if (last.min_sine > best_sine) {
      best = x;
      best_sine = last.min_sine;
    }
    energy = energy->with_corner_lengths(x);
    worst = energy->worst_distortion(x);
    const bool free = !newton.stalled() && last.damping > short_step;
    bound = worst + (free ? closer : away) * (bound - worst);
    bound = std::min(bound, farthest * worst);
  } while (++round < limits.rounds && best_sine < limits.enough && recorder.remaining() > 0 &&
           progress.worthwhile(worst));
  x = std::move(best);
  recorder.restore_outcome(outcome);
}

}  // namespace winslow
