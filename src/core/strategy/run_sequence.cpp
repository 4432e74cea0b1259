#include "core/strategy/run_sequence.h"

#include "core/strategy/smooth_run.h"

namespace winslow {

namespace {

/// Copies the outcome of a run.
void take_outcome(SmoothResult& all, const SmoothResult& run) {
  all.converged = run.converged;
  all.residual = run.residual;
  all.inverted = run.inverted;
  all.out_of_iterations = run.out_of_iterations;
  all.linear_solver = run.linear_solver;
  all.kept_outside = run.kept_outside;
  all.prescribed_inside = run.prescribed_inside;
  all.boundary = run.boundary;
}

/// Interpolates the nodes of a column between wall and rim, in proportion to its heights.
void fill_between(const LayerColumn& column, Coordinates& x) {
  const Vec2 wall = x.xy(column.wall_node), rim = x.xy(column.rim());
  const double thickness = column.thickness();
  double height = 0;
  for (std::size_t k = 0; k + 1 < column.count(); ++k) {
    height += column.heights[k];
    x.set_xy(column.nodes[k + 1], wall + (height / thickness) * (rim - wall));
  }
}

}  // namespace

void append(SmoothResult& all, SmoothResult more) {
  for (IterationRecord& record : more.history) record.iteration += all.outer_iterations;
  all.history.insert(all.history.end(), more.history.begin(), more.history.end());
  all.outer_iterations += more.outer_iterations;
  all.linear_solves += more.linear_solves;
  take_outcome(all, more);
}

void RelayMonitor::begin(int first, const LayerStack* fill) {
  first_ = first;
  fill_ = fill;
}

void RelayMonitor::on_topology(const std::shared_ptr<const Topology>& topology) {
  if (monitor_) monitor_->on_topology(topology);
}

bool RelayMonitor::on_iteration(const IterationRecord& record, const Coordinates& x) {
  if (!monitor_) return true;
  IterationRecord numbered = record;
  numbered.iteration += first_;
  if (!fill_) return monitor_->on_iteration(numbered, x);
  Coordinates filled = x;
  for (const LayerColumn& column : fill_->columns) fill_between(column, filled);
  return monitor_->on_iteration(numbered, filled);
}

RunSequence::RunSequence(const RunOptions& run, SmoothResult& result)
    : relay_(run.monitor), options_(run), result_(result) {
  options_.monitor = &relay_;
  options_.start = nullptr;
  options_.near = {};
}

SmoothResult RunSequence::smooth(const MeshState& state, const SmoothOptions& smooth,
                                 Coordinates& x) {
  relay_.begin(result_.outer_iterations, nullptr);
  SmoothResult result = smooth_interior(state, smooth, x, options_);
  append(result_, result);
  return result;
}

double RunSequence::open(const MeshState& outside, const LayerStack& stack, const Motion& motion,
                         const SmoothOptions& smooth, Coordinates& x) {
  relay_.begin(result_.outer_iterations, &stack);
  RunOptions own = options_;
  own.cache = nullptr;   // another connectivity, used only here
  own.bodies = nullptr;  // rims are no bodies
  SmoothResult result = smooth_motion(outside, motion, {}, smooth, x, own);
  const double reached = result.fraction_reached;
  append(result_, std::move(result));
  return reached;
}

void RunSequence::move(const MeshState& state, const Motion& motion, const MotionOptions& how,
                       const SmoothOptions& smooth, const Coordinates* start, Coordinates& x) {
  relay_.begin(result_.outer_iterations, nullptr);
  RunOptions own = options_;
  own.start = start;
  SmoothResult result = smooth_motion(state, motion, how, smooth, x, own);
  result_.fraction_reached = result.fraction_reached;
  result_.limited_by = result.limited_by;
  result_.contact = result.contact;
  result_.gap = result.gap;
  result_.held_inversion = result.held_inversion;
  result_.increments = result.increments;
  append(result_, std::move(result));
}

void RunSequence::fall_back_to(const SmoothResult& run) { take_outcome(result_, run); }

}  // namespace winslow
