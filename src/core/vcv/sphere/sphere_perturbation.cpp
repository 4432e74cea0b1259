#include "core/vcv/sphere/sphere_perturbation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/vcv/sphere/star_cost.h"

namespace winslow {

namespace {

/// In [0, 1), the same on every machine.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

}  // namespace

int perturb_directions(const SphereLink& link, std::span<const double> targets,
                       const PerturbationOptions& options, std::uint64_t seed,
                       std::span<Vec3> directions) {
  constexpr double worthwhile = 0.01;
  std::mt19937_64 generator(seed);
  double reach = options.first_reach;
  int sweeps = 0;
  while (sweeps < options.most_sweeps && reach >= options.least_reach) {
    ++sweeps;
    double best_gain = 0;
    for (Index v = 0; v < link.vertex_count(); ++v) {
      Vec3& p = directions[at(v)];
      const double before = vertex_cost(link, v, targets, directions);
      double cost = before;
      for (int k = 0; k < options.directions; ++k) {
        const Vec3 old = p;
        const Vec3 first = old.unitOrthogonal();
        const Vec3 second = old.cross(first);
        const double angle = 2 * pi * uniform(generator);
        p = (old + reach * (std::cos(angle) * first + std::sin(angle) * second)).normalized();
        const double trial = vertex_cost(link, v, targets, directions);
        if (trial < cost) {
          cost = trial;
        } else {
          p = old;
        }
      }
      best_gain = std::max(best_gain, 1 - cost / before);
    }
    if (best_gain < worthwhile) reach *= 0.5;
  }
  return sweeps;
}

}  // namespace winslow
