#include "core/strategy/run_recorder.h"

#include <algorithm>

#include "core/error.h"

namespace winslow {

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

IterationRecord RunRecorder::iterate(OuterSolver& solver, Coordinates& x, Stage stage,
                                     double fraction, int limit, const Enough& enough) {
  int counted = solver.linear_solves();
  IterationRecord record = solver.start(x);
  report(record, x, stage, fraction, false);
  const int most = std::min(limit, remaining());
  for (int done = 0; done < most && !solver.converged() && !solver.stalled(); ++done) {
    if (enough && enough(record)) break;
    record = solver.step(x);
    result_.linear_solves += solver.linear_solves() - counted;
    counted = solver.linear_solves();
    report(record, x, stage, fraction, true);
  }
  result_.converged = solver.converged();
  result_.stuck_nodes = solver.stuck_nodes();
  if (result_.converged) result_.out_of_iterations = false;
  return record;
}

void RunRecorder::restore_outcome(const SmoothResult& earlier) {
  result_.converged = earlier.converged;
  result_.residual = earlier.residual;
  result_.out_of_iterations = earlier.out_of_iterations;
  result_.fraction_reached = earlier.fraction_reached;
  result_.limited_by = earlier.limited_by;
  result_.contact = earlier.contact;
  result_.gap = earlier.gap;
  result_.increments = earlier.increments;
  result_.linear_solver = earlier.linear_solver;
  result_.inverted = earlier.inverted;
  result_.stuck_nodes = earlier.stuck_nodes;
}

}  // namespace winslow
