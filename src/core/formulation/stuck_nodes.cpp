#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/formulation/surface_winslow.h"

namespace winslow {

namespace {

/// The surface turns between two feet by more than a fold at least does.
bool turns(const Foot& from, const Foot& to) {
  const double cos_fold = std::cos(10 * M_PI / 180);
  const int count = std::min(from.frame.count(), to.frame.count());
  if (count == 0) return false;
  if (count == 1) return std::abs(from.frame[0].dot(to.frame[0])) < cos_fold;
  const Vec3 before = from.frame[0].cross(from.frame[1]);
  return std::abs(before.dot(to.frame[0].cross(to.frame[1]))) < cos_fold;
}

}  // namespace

/// A short way between two feet leads to another place of the surface, or over a fold: there it
/// turns at once, and not little by little as where it is only curved.
bool SurfaceWinslow::leads_astray(Index row, const Foot& from, const Foot& to, double way) const {
  constexpr double far = 4;
  constexpr int halvings = 6;
  if ((to.point - from.point).norm() > far * way) return true;
  const NodeUnknowns& nodes = node_unknowns();
  Foot first = from, last = to;
  for (int i = 0; i < halvings && turns(first, last); ++i) {
    const Foot middle =
        nodes.classes().foot(nodes.nodes()[at(row)], 0.5 * (first.point + last.point));
    (turns(first, middle) ? last : first) = middle;
  }
  return turns(first, last);
}

std::vector<bool> SurfaceWinslow::turned_over(const Coordinates& x) const {
  const FlatCells cells = own_planes(x);
  std::vector<bool> turned(cells.planes.size());
  for (std::size_t t = 0; t < turned.size(); ++t) turned[t] = !(cells.determinant(t) > 0);
  return turned;
}

Index SurfaceWinslow::stuck_nodes() const {
  return static_cast<Index>(std::ranges::count(stuck_, true));
}

std::shared_ptr<const EnergyProblem> SurfaceWinslow::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const {
  const auto rows = node_unknowns().nodes().size();
  Coordinates there = x;
  advance(direction, step, there);
  std::vector<bool> stuck = stuck_.empty() ? std::vector<bool>(rows, false) : stuck_;
  const std::vector<Foot> from = feet(x), to = feet(there);
  for (std::size_t row = 0; row < rows; ++row) {
    const double way = step * Vec2(direction[2 * row], direction[2 * row + 1]).norm();
    if (way > 0 && leads_astray(static_cast<Index>(row), from[row], to[row], way))
      stuck[row] = true;
  }
  // Of the nodes of elements that turn over on the way, those that turn one on their own.
  const std::vector<bool> before = turned_over(x), after = turned_over(there);
  for (std::size_t t = 0; t < after.size(); ++t) {
    if (!after[t] || before[t]) continue;
    std::vector<Index> moved;
    bool found = false;
    for (const Index node : structure_->cells[t]) {
      const Index row = structure_->row_of_node[at(node)];
      if (row < 0 || (!stuck_.empty() && stuck_[at(row)])) continue;
      moved.push_back(row);
      std::vector<double> alone(direction.size(), 0.0);
      for (const std::size_t k : {2 * at(row), 2 * at(row) + 1}) alone[k] = direction[k];
      Coordinates y = x;
      advance(alone, step, y);
      if (!turned_over(y)[t]) continue;
      stuck[at(row)] = found = true;
    }
    if (found) continue;
    for (const Index row : moved) stuck[at(row)] = true;
  }
  if (std::ranges::count(stuck, true) == stuck_nodes()) return nullptr;
  auto other = std::make_shared<SurfaceWinslow>(*this);
  other->stuck_ = std::move(stuck);
  return other;
}

}  // namespace winslow
