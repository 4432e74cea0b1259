#include "core/formulation/stencil_operator.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/error.h"
#include "core/vcv/sphere/sphere_fit.h"
#include "support/links.h"

using namespace winslow;
using namespace winslow::test;

namespace {

struct Stencil {
  SphereLink link;
  std::vector<Vec3> points;
  std::vector<VolumeFunctional> functionals;
};

Stencil stencil_of(const Triangles& triangles, std::vector<Vec3> points) {
  Stencil s{link_of(triangles), std::move(points), {}};
  s.functionals.resize(s.points.size());
  compute_functionals(s.link, s.points, s.functionals);
  return s;
}

/// Edges of random lengths.
Stencil random_stencil(Random& random) {
  const Triangles triangles = random_sphere(random, 5 + random.index(15), 80);
  std::vector<Vec3> points(at(link_of(triangles).vertex_count()));
  SphereStart().place(link_of(triangles), points);
  for (Vec3& p : points) p *= random.uniform(0.5, 2);
  return stencil_of(triangles, points);
}

Eigen::Matrix3d random_matrix(Random& random) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = random.uniform(-1, 1);
  return m;
}

Eigen::Matrix3d flux_matrix(const VolumeFunctional& f) {
  Eigen::Matrix3d l;
  l << f.lxx, f.lxy / 2, f.lzx / 2, f.lxy / 2, f.lyy, f.lyz / 2, f.lzx / 2, f.lyz / 2, f.lzz;
  return l;
}

}  // namespace

TEST_CASE("the gradient functionals are exact for linear functions, and their flux is zero") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Stencil s = random_stencil(random);
    const Eigen::Matrix3d a = random_matrix(random), b = random_matrix(random);
    const Eigen::Matrix3d k = b.transpose() * b;
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    Vec3 flux(0, 0, 0);
    double size = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const Vec3 image = a * s.points[i];
      const VolumeFunctional& f = s.functionals[i];
      gradient += image * Vec3(f.dx, f.dy, f.dz).transpose();
      flux += winslow_weight(k, f) * image;
      size += std::abs(winslow_weight(k, f)) * image.norm();
      CHECK(winslow_weight(k, f) ==
            doctest::Approx((k.array() * flux_matrix(f).array()).sum()).epsilon(1e-9));
    }
    CHECK((gradient - a).norm() < 1e-11);
    CHECK(flux.norm() < 1e-12 * size);
  }
}

TEST_CASE("weights are the flux through the outer triangles, integrated one by one") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Stencil s = random_stencil(random);
    const Eigen::Matrix3d b = random_matrix(random), k = b.transpose() * b;
    std::vector<double> u;  // values at the neighbours, 0 at the node
    for (std::size_t i = 0; i < s.points.size(); ++i) u.push_back(random.uniform(-1, 1));
    double flux = 0, expected = 0;
    for (std::size_t i = 0; i < u.size(); ++i) flux += winslow_weight(k, s.functionals[i]) * u[i];
    for (const auto& [p, q, r] : s.link.triangles()) {
      Eigen::Matrix3d corners;
      corners << s.points[at(p)].transpose(), s.points[at(q)].transpose(),
          s.points[at(r)].transpose();
      const Vec3 gradient = corners.inverse() * Vec3(u[at(p)], u[at(q)], u[at(r)]);
      const Vec3 normal =
          0.5 * (s.points[at(q)] - s.points[at(p)]).cross(s.points[at(r)] - s.points[at(p)]);
      expected += normal.dot(k * gradient);
    }
    CHECK(flux == doctest::Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("the octahedron's stencil loses all mixed derivatives") {
  const Stencil s = stencil_of(
      double_pyramid(4), {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  for (const VolumeFunctional& f : s.functionals) {
    CHECK(std::abs(f.lxy) < 1e-15);
    CHECK(std::abs(f.lyz) < 1e-15);
    CHECK(std::abs(f.lzx) < 1e-15);
  }
  CHECK(s.functionals[0].lxx == doctest::Approx(2));
  CHECK(std::abs(s.functionals[0].lyy) < 1e-15);
}

TEST_CASE("a VCV with an inverted tetrahedron has no functionals") {
  std::vector<Vec3> points{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::swap(points[4], points[5]);
  std::vector<VolumeFunctional> out(6);
  CHECK_THROWS_AS(compute_functionals(link_of(double_pyramid(4)), points, out), NumericError);
}

TEST_CASE("the Winslow tensor is the adjugate of the metric, of mean 1") {
  Random random(29);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d d = random_matrix(random);
    const Eigen::Matrix3d g = d.transpose() * d;
    Eigen::Matrix3d expected = g.determinant() * g.inverse();
    expected /= expected.trace() / 3;
    CHECK((winslow_tensor(d) - expected).norm() < 1e-8 * expected.norm());
    // It forgets the size of the map and how it is turned.
    CHECK((winslow_tensor(2.5 * d) - winslow_tensor(d)).norm() < 1e-12 * expected.norm());
  }
  CHECK(winslow_tensor(Eigen::Matrix3d::Zero()) == Eigen::Matrix3d::Identity());
}
