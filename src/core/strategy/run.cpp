#include "core/strategy/run.h"

#include "core/error.h"

namespace winslow {

namespace {

/// What holds the boundary under the bodies, as clauses. contact: only what takes part in it.
std::string held_footholds(const SmoothResult& result, const EdgePair* contact) {
  std::string text;
  for (const HeldFoothold& held : result.boundary.held_footholds)
    if (!contact || contact->moving == held.marker || contact->other == held.marker)
      text += "; " + held.description();
  return text;
}

}  // namespace

std::string why_incomplete(const SmoothResult& result) {
  if (result.held_inversion) return describe(*result.held_inversion);
  if (result.contact)
    return describe(*result.contact) + held_footholds(result, &result.contact->edges);
  if (!result.limited_by.empty()) return result.limited_by + " beyond";
  if (result.out_of_iterations) return "the limit of iterations was reached";
  std::string text = "no valid mesh was found beyond";
  if (const std::string held = held_footholds(result, nullptr); !held.empty()) return text + held;
  if (result.gap) text += "; " + describe(*result.gap);
  return text;
}

bool gains_no_more(const SmoothResult& result) {
  // Iterations after the solution, which raise the worst element, do not affect the outcome.
  const auto last = std::find_if(result.history.rbegin(), result.history.rend(),
                                 [](const IterationRecord& r) { return r.stage != Stage::worst; });
  const bool ended_by_newton = last != result.history.rend() && last->stage == Stage::newton;
  return ended_by_newton && !result.converged && !result.out_of_iterations &&
         result.inverted == 0 && result.fraction_reached >= 1 && result.limited_by.empty();
}

void RunRecorder::report(IterationRecord record, const Coordinates& x, Stage stage, double fraction,
                         bool advance) {
  if (advance) ++result_.outer_iterations;
  record.iteration = result_.outer_iterations;
  record.stage = stage;
  record.fraction = fraction;
  result_.history.push_back(record);
  result_.residual = record.residual;
  result_.inverted = record.inverted;
  result_.fraction_reached = fraction;
  result_.out_of_iterations = remaining() <= 0;
  if (monitor_ && !monitor_->on_iteration(record, x)) throw Cancelled();
}

namespace {

/// Asks the monitor during long solver steps whether to cancel.
class Checkpoints {
 public:
  Checkpoints(OuterSolver& solver, SolverMonitor* monitor) : solver_(solver) {
    if (!monitor) return;
    solver_.set_checkpoint([monitor] {
      if (monitor->cancelled()) throw Cancelled();
    });
  }
  ~Checkpoints() { solver_.set_checkpoint({}); }
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

 private:
  OuterSolver& solver_;
};

}  // namespace

void RunRecorder::note_memory(const OuterSolver& solver) {
  if (!shared_) return;
  MemoryUse use;
  shared_(use);
  solver.count(use);
  if (use.total() > result_.memory.total()) result_.memory = use;
}

IterationRecord RunRecorder::iterate(OuterSolver& solver, Coordinates& x, Stage stage,
                                     double fraction, int limit, const Enough& enough) {
  const Checkpoints checkpoints(solver, monitor_);
  int counted = solver.linear_solves();
  constexpr double caught_up = 0.01, least = 1e-10;
  IterationRecord record = solver.start(x);
  report(record, x, stage, fraction, false);
  if (std::exchange(interior_is_behind_, false))
    caught_up_ = std::max(caught_up * record.residual, least);
  double before = std::numeric_limits<double>::infinity();  // residual, an iteration ago
  const auto ended = [&] {
    const bool behind = record.residual > caught_up_ && record.residual < before;
    return solver.stalled() || (solver.converged() && !behind);
  };
  const int most = std::min(limit, remaining());
  for (int done = 0; done < most && !ended(); ++done) {
    if (enough && enough(record)) break;
    before = record.residual;
    record = solver.step(x);
    result_.linear_solves += solver.linear_solves() - counted;
    counted = solver.linear_solves();
    report(record, x, stage, fraction, true);
  }
  note_memory(solver);
  result_.converged = solver.converged();
  result_.stuck_nodes = solver.stuck_nodes();
  if (result_.converged) result_.out_of_iterations = false;
  return record;
}

}  // namespace winslow
