#include "core/vcv/sphere/star_builder.h"

#include <random>

namespace winslow {

double tetrahedron_aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double volume6 = a.dot(bc);
  if (!(volume6 > 0)) return std::numeric_limits<double>::infinity();
  // The circumcentre x has x . p = |p|^2 / 2 for each corner p; r = 3 V / (surface).
  const double circumradius =
      (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab).norm() / (2 * volume6);
  const double surface2 = bc.norm() + ca.norm() + ab.norm() + (b - a).cross(c - a).norm();
  return circumradius * surface2 / (3 * volume6);
}

double tetrahedron_cost(const Vec3& a, const Vec3& b, const Vec3& c, double wanted) {
  const double jacobian = a.dot(b.cross(c));
  if (jacobian < 0) return 1 - jacobian;
  const double off = 1 + std::abs(solid_angle(a, b, c) - wanted);
  return 1 - 1 / (tetrahedron_aspect_ratio(a, b, c) * off * off);
}

double BlendedCost::value() const {
  if (count_ == 0) return 0;
  const double r = largest_ * largest_ * largest_;
  return r * largest_ + std::max(0.0, 1 - r) * squares_ / count_;
}

double vertex_cost(const SphereLink& link, Index vertex, std::span<const double> targets,
                   std::span<const Vec3> directions) {
  BlendedCost cost;
  for (const Index h : link.outgoing(vertex)) {
    const auto [a, b, c] = link.triangles()[at(h / 3)];
    cost.add(tetrahedron_cost(directions[at(a)], directions[at(b)], directions[at(c)],
                              targets[at(h / 3)]));
  }
  return cost.value();
}

StarCost star_cost(const SphereLink& link, std::span<const double> targets,
                   std::span<const Vec3> directions) {
  StarCost cost{std::numeric_limits<double>::infinity(), 0};
  for (Index v = 0; v < link.vertex_count(); ++v) {
    const double own = vertex_cost(link, v, targets, directions);
    cost.min = std::min(cost.min, own);
    cost.max = std::max(cost.max, own);
  }
  return cost;
}

namespace {

/// Uniform in [0, 1), the same on every machine.
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

namespace {

double equal_angle(const SphereLink& link) { return 4 * pi / link.triangle_count(); }

}  // namespace

SphereFitOptions VolumeVcvOptions::fit() const {
  SphereFitOptions options;
  options.least_regularisation =
      angles == VcvAngles::equal ? equal_regularisation : physical_regularisation;
  options.regularisation = std::max(options.regularisation, options.least_regularisation);
  return options;
}

std::span<const double> StarTargets::equal(const SphereLink& link) {
  angles_.assign(at(link.triangle_count()), equal_angle(link));
  return angles_;
}

void StarTargets::measure(const SphereLink& link, std::span<const Vec3> physical, double floor) {
  angles_.clear();
  for (const auto& [a, b, c] : link.triangles()) {
    const double angle = solid_angle(physical[at(a)], physical[at(b)], physical[at(c)]);
    angles_.push_back(angle > floor ? angle : floor);  // a NaN, too
  }
}

std::span<const double> StarTargets::scaled() {
  double sum = 0;
  for (const double angle : angles_) sum += angle;
  for (double& angle : angles_) angle *= 4 * pi / sum;
  return angles_;
}

std::span<const double> StarTargets::existing(const SphereLink& link,
                                              std::span<const Vec3> physical) {
  constexpr double least = 0.01;
  measure(link, physical, least * equal_angle(link));
  return scaled();
}

std::span<const double> StarTargets::adjusted(const SphereLink& link,
                                              std::span<const Vec3> physical) {
  measure(link, physical, 0);
  const double equal = equal_angle(link);
  for (double& angle : angles_) angle = 0.5 * (angle + equal);
  return scaled();
}

std::span<const double> StarTargets::of_kind(VcvAngles kind, const SphereLink& link,
                                             std::span<const Vec3> physical) {
  switch (kind) {
    case VcvAngles::existing:
      return existing(link, physical);
    case VcvAngles::adjusted:
      return adjusted(link, physical);
    case VcvAngles::equal:
      break;
  }
  return equal(link);
}

void physical_directions(const SpacePoints& x, Index node, std::span<const Index> neighbours,
                         std::vector<Vec3>& out) {
  out.clear();
  const Vec3 centre = x[node];
  for (const Index other : neighbours) {
    const Vec3 edge = x[other] - centre;
    out.push_back(edge / edge.norm());
  }
}

void graded_lengths(const SpacePoints& x, Index node, std::span<const Index> neighbours,
                    double power, std::vector<double>& out) {
  // Coincident nodes in a tangled mesh still need a positive edge length.
  constexpr double most = 1e3;
  double sum = 0;
  for (const Index other : neighbours) sum += (x[other] - x[node]).norm();
  const double mean = sum / static_cast<double>(neighbours.size());
  out.clear();
  for (const Index other : neighbours) {
    const double share = mean > 0 ? (x[other] - x[node]).norm() / mean : 1;
    out.push_back(std::pow(std::clamp(share, 1 / most, most), power));
  }
}

SphereFitResult StarBuilder::build(const SphereLink& link, std::span<const double> targets,
                                   const SphereFitOptions& options, std::uint64_t seed,
                                   std::span<Vec3> directions) {
  if (!covers_sphere(link, directions)) start_.place(link, directions);
  if (construction_ == VcvConstruction::fit) return fit_.fit(link, targets, options, directions);
  SphereFitResult result;
  result.steps = perturb_directions(link, targets, {}, seed, directions);
  result.largest_error = largest_angle_error(link, targets, directions);
  // The perturbation balances shape and angles until it ends.
  result.end = result.largest_error <= options.tolerance ? SphereFitEnd::converged
                                                         : SphereFitEnd::limited_by_shape;
  return result;
}

double largest_angle_error(const SphereLink& link, std::span<const double> targets,
                           std::span<const Vec3> directions) {
  double largest = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto [a, b, c] = link.triangles()[t];
    const double angle = solid_angle(directions[at(a)], directions[at(b)], directions[at(c)]);
    largest = std::max(largest, std::abs(angle / targets[t] - 1));
  }
  return largest;
}

}  // namespace winslow
