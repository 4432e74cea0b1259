#pragma once

#include <Eigen/LU>
#include <cmath>
#include <span>
#include <vector>

#include "core/vcv/stencil_functionals.h"
#include "support/random.h"

/// Control volumes for tests, and the operator over them worked out the slow way.
namespace winslow::test {

inline Vec2 polar(double length, double angle) {
  return length * Vec2(std::cos(angle), std::sin(angle));
}

inline std::vector<Vec2> regular_polygon(Index n) {
  std::vector<Vec2> points;
  for (Index k = 0; k < n; ++k) points.push_back(polar(1, 2 * pi * k / n));
  return points;
}

/// Angles in (0, pi) that sum to 2 pi.
inline std::vector<double> random_angles(Random& random, Index n) {
  for (;;) {
    std::vector<double> angles;
    double sum = 0;
    for (Index k = 0; k < n; ++k) {
      angles.push_back(random.uniform(0.3, 1.7));
      sum += angles.back();
    }
    bool good = true;
    for (double& angle : angles) {
      angle *= 2 * pi / sum;
      good = good && angle < 0.95 * pi;
    }
    if (good) return angles;
  }
}

/// A VCV with random angles, edge lengths and orientation.
inline std::vector<Vec2> random_vcv(Random& random, Index n) {
  std::vector<Vec2> points;
  double phi = random.uniform(0, 2 * pi);
  for (const double angle : random_angles(random, n)) {
    points.push_back(polar(random.uniform(0.3, 3), phi));
    phi += angle;
  }
  return points;
}

inline std::vector<NeighbourFunctionals> functionals_of(std::span<const Vec2> points) {
  std::vector<NeighbourFunctionals> f(points.size());
  compute_functionals(points, f);
  return f;
}

inline std::vector<double> weights_of(std::span<const NeighbourFunctionals> functionals,
                                      double alpha, double beta, double gamma) {
  std::vector<double> w;
  for (const auto& f : functionals) w.push_back(alpha * f.lxx - beta * f.lxy + gamma * f.lyy);
  return w;
}

/// Gradient (rows: components of r, columns: x and y) of the linear function with value r_0 at the
/// origin, r_1 at p and r_2 at q, from a 2 by 2 system.
inline Eigen::Matrix2d triangle_gradient(const Vec2& p, const Vec2& q, const Vec2& r0,
                                         const Vec2& r1, const Vec2& r2) {
  Eigen::Matrix2d edges, differences;
  edges << p, q;
  differences << r1 - r0, r2 - r0;
  return differences * edges.inverse();
}

struct BruteForce {
  Eigen::Matrix2d gradient;  // area-weighted mean over the VCV's triangles
  Vec2 residual;             // sum over outer edges of (gradient of the triangle) K N
};

/// The operator at one node, triangle by triangle.
inline BruteForce integrate(std::span<const Vec2> points, const Vec2& r0, std::span<const Vec2> r,
                            const Eigen::Matrix2d& k_matrix) {
  BruteForce result{Eigen::Matrix2d::Zero(), Vec2::Zero()};
  double area = 0;
  for (std::size_t t = 0; t < points.size(); ++t) {
    const std::size_t u = (t + 1) % points.size();
    const Eigen::Matrix2d g = triangle_gradient(points[t], points[u], r0, r[t], r[u]);
    const Vec2 edge = points[u] - points[t];
    const Vec2 normal(edge.y(), -edge.x());
    const double triangle = 0.5 * cross(points[t], points[u]);
    result.gradient += triangle * g;
    area += triangle;
    result.residual += g * k_matrix * normal;
  }
  result.gradient /= area;
  return result;
}

/// K = [[alpha, -beta], [-beta, gamma]] of a Jacobian.
inline Eigen::Matrix2d winslow_matrix(const Eigen::Matrix2d& jacobian) {
  const Vec2 rx = jacobian.col(0), ry = jacobian.col(1);
  Eigen::Matrix2d k;
  k << ry.squaredNorm(), -rx.dot(ry), -rx.dot(ry), rx.squaredNorm();
  return k;
}

}  // namespace winslow::test
