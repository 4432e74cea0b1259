#include "core/outer/path_follower.h"

namespace winslow {

namespace {

/// Displacements of all nodes from one mesh to another.
Coordinates displacements(const Coordinates& from, const Coordinates& to) {
  Coordinates out = to;
  const auto values = out.values();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= from.values()[i];
  return out;
}

}  // namespace

PathFollower::Trial PathFollower::attempt(const Path& path, const Goal& goal, Coordinates& x,
                                          IterationRecord& record) {
  if (path.change_problem) path.change_problem(goal.fraction);
  const SmoothingProblem& problem = solver_.problem();
  Coordinates moved = x;
  path.move(goal.fraction, moved);
  const Coordinates displacement = displacements(x, moved);
  std::vector<double> answer(problem.unknowns());
  goal.correct ? solver_.predict_and_correct(x, displacement, answer)
               : solver_.predict(x, displacement, answer);
  problem.advance(answer, 1, moved);
  Trial trial;
  constexpr double beyond = 1.1;  // of the step: more is not asked for
  trial.possible = problem.largest_valid_step(x, moved, beyond);
  if (trial.possible <= 1 || problem.validity(moved).inverted > 0) return trial;
  trial.valid = true;
  record = solver_.start(moved);
  trial.trusted = record.residual <= options_.trusted_residual;
  if (!trial.trusted) return trial;
  x = std::move(moved);
  const double tolerance = (goal.cut ? options_.tightened : 1) * options_.loose_tolerance;
  constexpr double worthwhile = 1.2;  // growth of the smallest sine by one correction
  double before = 0;
  const auto off_path = [&] {
    if (record.residual > tolerance) return true;
    return record.min_sine < options_.flattened * goal.min_sine &&
           record.min_sine > worthwhile * before;
  };
  while (off_path() && trial.corrections < options_.most_corrections) {
    before = record.min_sine;
    const bool needed = record.residual > options_.loose_tolerance;
    Coordinates near = needed ? Coordinates() : x;
    const IterationRecord was = record;
    record = solver_.step(x);
    ++trial.corrections;
    if (!needed && (record.damping < 1 || record.residual > options_.loose_tolerance)) {
      x = std::move(near);
      record = was;
      break;
    }
    if (record.damping < 1) trial.trusted = false;
    // Repeatedly cut Newton steps progress slowly and solve the worst conditioned systems: a
    // shorter path step is better.
    if (!trial.trusted && goal.may_shorten) return trial;
  }
  if (record.residual > options_.loose_tolerance) trial.trusted = false;
  return trial;
}

double PathFollower::follow(const Path& path, double from, Coordinates& x, const Accept& accept) {
  const double reached = go(path, from, x, accept);
  if (path.change_problem) path.change_problem(reached);
  return reached;
}

double PathFollower::go(const Path& path, double from, Coordinates& x, const Accept& accept) {
  double fraction = from;
  double step = options_.first_step;
  const double min_sine = solver_.problem().validity(x).min_sine;
  bool correct = true, cut = false;
  int short_steps = 0;  // in a row, with meshes away from the path
  while (fraction < 1) {
    // Slightly lengthens the last step to avoid a very short one.
    constexpr double stretch = 1.05;
    const double to = fraction + stretch * step >= 1 ? 1.0 : fraction + step;
    Coordinates trial_x = x;
    IterationRecord record;
    // The correction does not decrease with the step: where the path is hard to follow, it would
    // dominate the prediction and lead away from the path.
    constexpr double long_step = 0.02;
    // If the problem changes, the correction from x is the prediction.
    const bool may_correct = path.change_problem || (correct && to - fraction > long_step);
    const bool may_shorten = to - fraction > options_.cautious_step;
    const Trial trial =
        attempt(path, {to, may_correct, may_shorten, cut, min_sine}, trial_x, record);
    if (!trial.valid) {
      correct = false;
      cut = true;
      constexpr double margin = 0.7;
      step = (to - fraction) * std::clamp(margin * trial.possible, 0.1, 0.7);
      if (step < options_.smallest_step) return fraction;
      continue;
    }
    if (!trial.trusted && !may_shorten && !options_.greedy) {
      solver_.reject();
      return fraction;
    }
    if (!trial.trusted && may_shorten) {
      correct = false;
      if (trial.corrections > 0) solver_.reject();
      step = 0.5 * (to - fraction);
      continue;
    }
    if (options_.admits && !options_.admits(trial_x)) {
      if (trial.corrections > 0) solver_.reject();
      correct = false;
      step = 0.5 * (to - fraction);
      if (step < options_.finest_step) return fraction;
      continue;
    }
    x = std::move(trial_x);
    constexpr double away = 0.01;  // residual
    short_steps = to - fraction < 2 * long_step && record.residual > away ? short_steps + 1 : 0;
    fraction = to;
    correct = true;
    cut = false;
    record.fraction = fraction;
    if (!accept(record, x)) break;
    if (options_.patience > 0 && short_steps >= options_.patience) break;
    if (trial.corrections <= 1) step *= options_.growth;
  }
  return fraction;
}

}  // namespace winslow
