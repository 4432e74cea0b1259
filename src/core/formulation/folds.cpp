#include "core/formulation/folds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/parallel/parallel_for.h"

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

/// way: length of the step in the tangent plane.
bool leads_astray(const NodeClasses& classes, Index node, const Foot& from, const Foot& to,
                  double way) {
  constexpr double far = 4;
  constexpr int halvings = 6;
  if ((to.point - from.point).norm() > far * way) return true;
  Foot first = from, last = to;
  for (int i = 0; i < halvings && turns(first, last); ++i) {
    const Foot middle = classes.foot(node, 0.5 * (first.point + last.point));
    (turns(first, middle) ? last : first) = middle;
  }
  return turns(first, last);
}

}  // namespace

Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck) {
  const NodeClasses& classes = nodes.classes();
  const SpacePoints before(x), after(there);
  std::vector<unsigned char> astray(stuck.size(), 0);
  constexpr Index block = 512;  // a foot may take a search
  const auto find = [&](Index begin, Index end) {
    for (std::size_t row = at(begin); row < at(end); ++row) {
      const Index node = nodes.nodes()[row];
      if (stuck[row] || !classes.slides(node)) continue;
      const auto of_node = direction.subspan(stride * row, stride);
      const double way = step * std::hypot(of_node[0], of_node[1]);
      if (!(way > 0)) continue;
      const Foot from = classes.foot(node, before[node]), to = classes.foot(node, after[node]);
      astray[row] = leads_astray(classes, node, from, to, way) ? 1 : 0;
    }
  };
  parallel_for(nodes.threads(), static_cast<Index>(stuck.size()), find, block);
  Index count = 0;
  for (std::size_t row = 0; row < stuck.size(); ++row) {
    if (astray[row] == 0) continue;
    stuck[row] = true;
    ++count;
  }
  return count;
}

}  // namespace winslow
