#include "core/formulation/folds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

/// At a fold the surface turns at once, and not little by little as where it is only curved.
bool leads_astray(const NodeUnknowns& nodes, Index row, const Foot& from, const Foot& to,
                  double way) {
  constexpr double far = 4;
  constexpr int halvings = 6;
  if ((to.point - from.point).norm() > far * way) return true;
  Foot first = from, last = to;
  for (int i = 0; i < halvings && turns(first, last); ++i) {
    const Foot middle =
        nodes.classes().foot(nodes.nodes()[at(row)], 0.5 * (first.point + last.point));
    (turns(first, middle) ? last : first) = middle;
  }
  return turns(first, last);
}

Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck) {
  const SpacePoints before(x), after(there);
  Index count = 0;
  for (std::size_t row = 0; row < stuck.size(); ++row) {
    const Index node = nodes.nodes()[row];
    if (stuck[row] || !nodes.classes().slides(node)) continue;
    double square = 0;
    for (const double u : direction.subspan(stride * row, stride)) square += u * u;
    const double way = step * std::sqrt(square);
    if (!(way > 0)) continue;
    const NodeClasses& classes = nodes.classes();
    const Foot from = classes.foot(node, before[node]), to = classes.foot(node, after[node]);
    if (!leads_astray(nodes, static_cast<Index>(row), from, to, way)) continue;
    stuck[row] = true;
    ++count;
  }
  return count;
}

}  // namespace winslow
