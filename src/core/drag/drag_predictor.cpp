#include "core/drag/drag_predictor.h"

#include <cmath>

#include "core/motion/rigid_motion.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec2 turned(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace

DragPredictor::DragPredictor(const Topology& topology, SteadySolver& solver, const Coordinates& x,
                             std::vector<Index> nodes, std::vector<double> shares, int threads)
    : base_(x),
      nodes_(std::move(nodes)),
      shares_(std::move(shares)),
      tangents_(at(x.size())),
      threads_(threads) {
  for (const Index node : nodes_) pivot_ += x.xy(node);
  if (!nodes_.empty()) pivot_ /= static_cast<double>(nodes_.size());
  const auto free = topology.free_nodes();
  Coordinates displacement(x.dimension(), x.size());
  std::vector<double> answer(2 * free.size());
  const auto solve_for = [&](Vec2 Tangents::*field, const auto& velocity) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Index node = nodes_[i];
      const Vec2 v = (shares_.empty() ? 1.0 : shares_[i]) * velocity(x.xy(node));
      tangents_[at(node)].*field = v;
      displacement.set_xy(node, v);
    }
    solver.predict(x, displacement, answer);
    for (std::size_t i = 0; i < free.size(); ++i) {
      tangents_[at(free[i])].*field = Vec2(answer[2 * i], answer[2 * i + 1]);
    }
  };
  solve_for(&Tangents::x, [](const Vec2&) { return Vec2(1, 0); });
  solve_for(&Tangents::y, [](const Vec2&) { return Vec2(0, 1); });
  if (!shares_.empty()) return;
  solve_for(&Tangents::r, [&](const Vec2& p) { return turned(p - pivot_); });
}

void DragPredictor::evaluate(const RigidMotion& motion, Coordinates& out) const {
  out = base_;
  const double angle = radians(motion.rotate);
  const double sine = std::sin(angle), rest = 1 - std::cos(angle);
  const Vec2 move = transform(motion, pivot_) - pivot_;
  parallel_for(threads_, base_.size(), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Tangents& u = tangents_[at(i)];
      double* p = out.point(i);
      p[0] += move.x() * u.x.x() + move.y() * u.y.x() + sine * u.r.x() - rest * u.r.y();
      p[1] += move.x() * u.x.y() + move.y() * u.y.y() + sine * u.r.y() + rest * u.r.x();
    }
  });
  // To the last bit where the motion itself takes them.
  if (shares_.empty())
    for (const Index node : nodes_) out.set_xy(node, transform(motion, base_.xy(node)));
}

}  // namespace winslow
