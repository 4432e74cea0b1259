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

/// A corner's two edges and how they change.
double corner_step(const double* a, const double* b, const double* c, const double* a1,
                   const double* b1, const double* c1) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
  const double dux = b1[0] - a1[0] - ux, duy = b1[1] - a1[1] - uy;
  const double dvx = c1[0] - a1[0] - vx, dvy = c1[1] - a1[1] - vy;
  const double d0 = ux * vy - uy * vx;
  if (!(d0 > 0)) return 0;
  return first_positive_root(d0, ux * dvy - uy * dvx + dux * vy - duy * vx, dux * dvy - duy * dvx);
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
  from.require_dimension(2);
  to.require_dimension(2);
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
        smallest = std::min(smallest, corner_step(from.point(a), from.point(b), from.point(c),
                                                  to.point(a), to.point(b), to.point(c)));
      }
    }
    steps[static_cast<std::size_t>(begin / parallel_block)] = smallest;
  });
  double smallest = infinite;
  for (const double step : steps) smallest = std::min(smallest, step);
  return smallest;
}

}  // namespace winslow
