#include "core/drag/drag_predictor.h"

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

Vec2 turned(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace

DragPredictor::DragPredictor(SteadySolver& solver, const Coordinates& x, std::vector<Index> nodes,
                             std::vector<double> shares, int threads)
    : base_(x), nodes_(std::move(nodes)), shares_(std::move(shares)), threads_(threads) {
  for (const Index node : nodes_) pivot_ += x.xy(node);
  if (!nodes_.empty()) pivot_ /= static_cast<double>(nodes_.size());
  for (int direction = 0; direction < x.dimension(); ++direction) {
    translations_.push_back(
        solve_for(solver, [&](Index) -> Vec2 { return Vec2::Unit(direction); }));
  }
  if (!shares_.empty()) return;
  rotation_ = solve_for(solver, [&](Index node) { return turned(x.xy(node) - pivot_); });
  turned_rotation_ = Coordinates(x.dimension(), x.size());
  for (Index node = 0; node < x.size(); ++node) {
    turned_rotation_.set_xy(node, turned(rotation_.xy(node)));
  }
}

/// Velocities of all nodes where those held have the given ones, or their shares of them.
template <typename Velocity>
Coordinates DragPredictor::solve_for(SteadySolver& solver, const Velocity& velocity) const {
  Coordinates field(base_.dimension(), base_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec2 v = velocity(nodes_[i]);
    if (!shares_.empty()) v *= shares_[i];
    field.set_xy(nodes_[i], v);
  }
  std::vector<double> answer(solver.problem().unknowns());
  solver.predict(base_, field, answer);
  solver.problem().velocities(base_, answer, field);
  return field;
}

void DragPredictor::evaluate(const RigidMotion& motion, Coordinates& out) const {
  out = base_;
  const double angle = radians(motion.rotate);
  const double sine = std::sin(angle), rest = 1 - std::cos(angle);
  const Vec2 move = transform(motion, pivot_) - pivot_;
  const double* x = translations_[0].values().data();
  const double* y = translations_[1].values().data();
  const double* r = rotation_.values().data();
  const double* q = turned_rotation_.values().data();
  double* p = out.values().data();
  parallel_for(threads_, static_cast<Index>(out.values().size()), [&](Index begin, Index end) {
    if (rotation_.empty()) {
      for (Index i = begin; i < end; ++i) p[i] += move.x() * x[i] + move.y() * y[i];
    } else {
      for (Index i = begin; i < end; ++i) {
        p[i] += move.x() * x[i] + move.y() * y[i] + sine * r[i] + rest * q[i];
      }
    }
  });
  // To the last bit where the motion itself takes them.
  if (shares_.empty())
    for (const Index node : nodes_) out.set_xy(node, transform(motion, base_.xy(node)));
}

}  // namespace winslow
