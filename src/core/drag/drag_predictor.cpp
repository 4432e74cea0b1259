#include "core/drag/drag_predictor.h"

#include <Eigen/Geometry>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// The velocity of a point in a unit rotation about an axis through 0, in the plane or in space.
Vec2 turning(const Vec2& v, int) { return {-v.y(), v.x()}; }
Vec3 turning(const Vec3& v, int axis) { return Vec3::Unit(axis).cross(v); }

template <int D>
std::vector<Points<D>> points_of(const std::vector<Coordinates>& fields) {
  return {fields.begin(), fields.end()};
}

}  // namespace

DragPredictor::DragPredictor(SteadySolver& solver, const Coordinates& x, std::vector<Index> nodes,
                             std::vector<double> shares, int threads)
    : base_(x), nodes_(std::move(nodes)), shares_(std::move(shares)), threads_(threads) {
  in_dimension(base_, [&]<int D>(const Points<D>& points) { prepare(solver, points); });
}

template <int D>
void DragPredictor::prepare(SteadySolver& solver, const Points<D>& points) {
  Vec<D> pivot = Vec<D>::Zero();
  for (const Index node : nodes_) pivot += points[node];
  if (!nodes_.empty()) pivot /= static_cast<double>(nodes_.size());
  pivot_.head<D>() = pivot;
  for (int direction = 0; direction < D; ++direction) {
    translations_.push_back(
        solve_for<D>(solver, [&](Index) -> Vec<D> { return Vec<D>::Unit(direction); }));
  }
  if (!shares_.empty()) return;
  constexpr int axes = D == 2 ? 1 : 3;
  for (int axis = 0; axis < axes; ++axis) {
    rotations_.push_back(solve_for<D>(
        solver, [&](Index node) -> Vec<D> { return turning(Vec<D>(points[node] - pivot), axis); }));
  }
}

/// Velocities of all nodes if the held nodes have the given ones, or shares of them.
template <int D, typename Velocity>
Coordinates DragPredictor::solve_for(SteadySolver& solver, const Velocity& velocity) const {
  Coordinates field(D, base_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec<D> v = velocity(nodes_[i]);
    if (!shares_.empty()) v *= shares_[i];
    field.set<D>(nodes_[i], v);
  }
  std::vector<double> answer(solver.problem().unknowns());
  solver.predict(base_, field, answer);
  solver.problem().velocities(base_, answer, field);
  return field;
}

void DragPredictor::evaluate(const RigidMotion& motion, Coordinates& out) const {
  in_dimension(base_, [&]<int D>(const Points<D>& base) { evaluate(motion, base, out); });
}

template <int D>
void DragPredictor::evaluate(const RigidMotion& motion, const Points<D>& base,
                             Coordinates& out) const {
  out = base_;
  const Vec3 move = transform(motion, pivot_) - pivot_;
  const double sine = std::sin(radians(motion.rotate)), rest = 1 - std::cos(radians(motion.rotate));
  const Vec3 axis = axis_of(motion).normalized();
  const auto translations = points_of<D>(translations_), rotations = points_of<D>(rotations_);
  parallel_for(threads_, base_.size(), [&](Index begin, Index end) {
    for (Index node = begin; node < end; ++node) {
      Vec<D> p = base[node];
      for (int k = 0; k < D; ++k) p += move[k] * translations[static_cast<std::size_t>(k)][node];
      if (!rotations.empty()) {
        if constexpr (D == 2) {
          const Vec2 u = rotations[0][node];
          p += sine * u + rest * turning(u, 0);
        } else {
          const Vec3 u = axis.x() * rotations[0][node] + axis.y() * rotations[1][node] +
                         axis.z() * rotations[2][node];
          p += sine * u + rest * axis.cross(u);
        }
      }
      out.set<D>(node, p);
    }
  });
  // Bitwise equal to the motion itself.
  if (shares_.empty())
    for (const Index node : nodes_) out.set<D>(node, transform(motion, base[node]));
}

}  // namespace winslow
