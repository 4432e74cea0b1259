#include "core/quality/valid_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of a corner, given by its node and the ends of its two edges.
double corner_step(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to) {
  const Vec2 u = from[1] - from[0], v = from[2] - from[0];
  const Vec2 du = to[1] - to[0] - u, dv = to[2] - to[0] - v;
  const double d0 = cross(u, v);
  if (!(d0 > 0)) return 0;
  return first_positive_root(d0, u.x() * dv.y() - u.y() * dv.x() + du.x() * v.y() - du.y() * v.x(),
                             cross(du, dv));
}

}  // namespace

double first_positive_root(double d0, double d1, double d2) {
  const double discriminant = d1 * d1 - 4 * d0 * d2;
  if (!(discriminant >= 0)) return infinite;
  // The form that does not cancel: roots q / d2 and d0 / q.
  const double q = -0.5 * (d1 + std::copysign(std::sqrt(discriminant), d1));
  double first = infinite;
  for (const double root : {d2 != 0 ? q / d2 : infinite, q != 0 ? d0 / q : infinite}) {
    if (root > 0) first = std::min(first, root);
  }
  return first;
}

double largest_valid_step(const Topology& topology, const Coordinates& from, const Coordinates& to,
                          int threads) {
  require_plane(topology, "steps that keep a mesh valid");
  const PlanePoints before(from), after(to);
  const Index n = topology.element_count();
  const auto blocks = static_cast<std::size_t>((n + parallel_block - 1) / parallel_block);
  std::vector<double> steps(blocks, infinite);
  parallel_for(threads, n, [&](Index begin, Index end) {
    double smallest = infinite;
    for (Index e = begin; e < end; ++e) {
      const auto nodes = topology.element(e);
      const std::size_t count = nodes.size();
      const std::size_t corners = count == 3 ? 1 : count;
      for (std::size_t k = 0; k < corners; ++k) {
        const Index a = nodes[k], b = nodes[(k + 1) % count], c = nodes[(k + count - 1) % count];
        smallest = std::min(smallest, corner_step({before[a], before[b], before[c]},
                                                  {after[a], after[b], after[c]}));
      }
    }
    steps[static_cast<std::size_t>(begin / parallel_block)] = smallest;
  });
  double smallest = infinite;
  for (const double step : steps) smallest = std::min(smallest, step);
  return smallest;
}

}  // namespace winslow
