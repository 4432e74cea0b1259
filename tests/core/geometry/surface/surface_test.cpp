#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/geometry/surface/surface.h"
#include "core/geometry/surface/surfaces.h"

namespace winslow::test {
namespace {

std::vector<Vec3> no_tangents(const Triangulation& surface) {
  return std::vector<Vec3>(surface.points.size(), Vec3(0, 0, 0));
}

SmoothSurface smooth(const Triangulation& surface) {
  return {surface, point_normals(surface, no_tangents(surface))};
}

/// Turned and moved somewhere.
Triangulation placed(Triangulation surface) {
  const Eigen::AngleAxisd turn(0.7, Vec3(1, -2, 0.5).normalized());
  for (Vec3& p : surface.points) p = turn * p + Vec3(3, -1, 12);
  return surface;
}

Triangulation cylinder(double radius) {
  return mapped_grid(16, 5, true, false, [radius](double u, double v) {
    return Vec3(radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), 3 * v);
  });
}

Triangulation half_sphere(double radius) {
  return mapped_grid(12, 6, true, false, [radius](double u, double v) {
    const double polar = 0.3 + 1.2 * v, a = 2 * pi * u;
    return Vec3(radius * std::sin(polar) * std::cos(a), radius * std::sin(polar) * std::sin(a),
                radius * std::cos(polar));
  });
}

/// Where a node that moves by u along the directions across the normal comes to, to second order.
void check_second_order(const Surface& surface, const Vec3& near) {
  const SurfacePoint here = surface.nearest(near);
  const Vec3 first = here.normal.unitOrthogonal(), second = here.normal.cross(first);
  CHECK((here.form * here.normal).norm() < 1e-9);
  constexpr double h = 1e-4;
  for (const Vec3& along : {first, second, Vec3((first + second).normalized())}) {
    const Vec3 ahead = surface.nearest(here.point + h * along).point;
    const Vec3 behind = surface.nearest(here.point - h * along).point;
    CHECK(((ahead - behind) / (2 * h) - along).norm() < 1e-6);
    const Vec3 bend = (ahead + behind - 2 * here.point) / (h * h);
    CHECK((bend - along.dot(here.form * along) * here.normal).norm() < 1e-4);
  }
}

}  // namespace

TEST_CASE("patches of triangles that share an edge share its curve and its tangent planes") {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.1);
  const auto shaken = [&](const Vec3& v) {
    return Vec3(v.x() + noise(random), v.y() + noise(random), v.z() + noise(random));
  };
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Vec3 a = shaken({0, 0, 0}), b = shaken({1, 0, 0}), c = shaken({0.4, 1, 0}),
               d = shaken({0.6, -1, 0});
    const Vec3 na = shaken({0, 0, 1}).normalized(), nb = shaken({0, 0, 1}).normalized(),
               nc = shaken({0, 0, 1}).normalized(), nd = shaken({0, 0, 1}).normalized();
    const SurfacePatch above({a, b, c}, {na, nb, nc}), below({b, a, d}, {nb, na, nd});
    for (const double t : {0.0, 0.2, 0.5, 0.77, 1.0}) {
      const auto p = above.derivatives(1 - t, t), q = below.derivatives(t, 1 - t);
      CHECK((p.r - q.r).norm() < 1e-14);
      const Vec3 m = p.u.cross(p.v).normalized(), n = q.u.cross(q.v).normalized();
      CHECK((m - n).norm() < 1e-12);
    }
    CHECK((above.derivatives(1, 0).r - a).norm() < 1e-15);
    CHECK((above.derivatives(0, 0).u.cross(above.derivatives(0, 0).v).normalized() - nc).norm() <
          1e-12);
  }
}

TEST_CASE("derivatives of a patch are those of its points") {
  const SurfacePatch patch({Vec3(0, 0, 0), Vec3(1, 0, 0.1), Vec3(0.3, 0.9, -0.1)},
                           {Vec3(-0.1, -0.2, 1).normalized(), Vec3(0.2, 0, 1).normalized(),
                            Vec3(0, 0.3, 1).normalized()});
  constexpr double h = 1e-5;
  for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.6, 0.1}, {0.05, 0.9}, {0.33, 0.33}}) {
    const auto d = patch.derivatives(u, v);
    const auto du = [&, u = u, v = v](double s) { return patch.derivatives(u + s, v); };
    const auto dv = [&, u = u, v = v](double s) { return patch.derivatives(u, v + s); };
    CHECK(((du(h).r - du(-h).r) / (2 * h) - d.u).norm() < 1e-8);
    CHECK(((dv(h).r - dv(-h).r) / (2 * h) - d.v).norm() < 1e-8);
    CHECK(((du(h).u - du(-h).u) / (2 * h) - d.uu).norm() < 1e-7);
    CHECK(((dv(h).u - dv(-h).u) / (2 * h) - d.uv).norm() < 1e-7);
    CHECK(((dv(h).v - dv(-h).v) / (2 * h) - d.vv).norm() < 1e-7);
  }
}

TEST_CASE("a patch is flat where its normals lean too far") {
  const std::array<Vec3, 3> vertices{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const SurfacePatch patch(vertices, {Vec3(0, 0, 1), Vec3(1, 0, 0.1).normalized(), Vec3(0, 0, 1)});
  CHECK((patch.derivatives(0.3, 0.3).r - Vec3(0.3, 0.4, 0) + Vec3(0, 0.1, 0)).norm() < 0.2);
  CHECK(patch.derivatives(0.3, 0.3).uu.norm() == 0);
}

TEST_CASE("planes, cylinders and spheres are recognised wherever they lie") {
  struct Expected {
    Triangulation surface;
    const char* description;
  };
  const Triangulation flat =
      mapped_grid(4, 3, false, false, [](double u, double v) { return Vec3(3 * u, v, 0); });
  for (const Expected& expected :
       {Expected{flat, "plane"}, Expected{cylinder(2), "cylinder of radius 2"},
        Expected{half_sphere(5), "sphere of radius 5"}}) {
    const char* const description = expected.description;
    CAPTURE(description);
    const Triangulation there = placed(expected.surface);
    const auto found = recognised_surface(there);
    REQUIRE(found);
    CHECK(found->description() == description);
    for (const Vec3& p : there.points) CHECK((found->nearest(p).point - p).norm() < 1e-12);
    const auto& t = there.triangles[5];
    check_second_order(*found, (there.points[at(t[0])] + there.points[at(t[1])]) / 2);
  }
}

TEST_CASE("what is no plane, cylinder or sphere is not taken for one") {
  CHECK(!recognised_surface(torus(20, 12)));
  Triangulation dented = half_sphere(1);
  dented.points[30] *= 0.999;
  CHECK(!recognised_surface(dented));
  const Triangulation cone = mapped_grid(16, 4, true, false, [](double u, double v) {
    return Vec3((1 + v) * std::cos(2 * pi * u), (1 + v) * std::sin(2 * pi * u), 3 * v);
  });
  CHECK(!recognised_surface(cone));
}

TEST_CASE("a smooth surface passes through its points and is near to what they were taken from") {
  double coarse = 0;
  for (const int n : {1, 2}) {
    const Triangulation surface = torus(28 * n, 14 * n);
    const SmoothSurface through = smooth(surface);
    for (const Vec3& p : surface.points) CHECK((through.nearest(p).point - p).norm() < 1e-13);
    double largest = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      for (const Vec3& place : {Vec3(1, 1, 1), Vec3(1, 1, 0), Vec3(3, 1, 1)})
        largest = std::max(
            largest,
            distance_from_torus(through.over(static_cast<Index>(t), place / place.sum()).point));
    if (n == 1) {
      coarse = largest;
      CHECK(largest < 2e-3);  // the triangles' own distance is .036
    } else {
      CHECK(largest < coarse / 6);
    }
  }
}

TEST_CASE("the nearest place of a smooth surface is the nearest, and it knows how it curves") {
  const Triangulation surface = torus(28, 14);
  const SmoothSurface through = smooth(surface);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.12, 0.12);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const auto& t = surface.triangles[random() % surface.triangles.size()];
    const Vec3 p = (surface.points[at(t[0])] + surface.points[at(t[1])]) / 2 +
                   Vec3(shift(random), shift(random), shift(random));
    const SurfacePoint foot = through.nearest(p);
    const Vec3 off = p - foot.point;
    CHECK(off.cross(foot.normal).norm() < 1e-11);
    // Brute force: no sampled place of any triangle is nearer.
    if (repeat > 20) continue;
    double least = 1e9;
    for (std::size_t k = 0; k < surface.triangles.size(); ++k)
      for (int i = 0; i <= 6; ++i)
        for (int j = 0; i + j <= 6; ++j)
          least = std::min(
              least,
              (through.over(static_cast<Index>(k), Vec3(i, j, 6 - i - j) / 6.0).point - p).norm());
    CHECK(off.norm() <= least + 1e-12);
  }
  const auto& t = surface.triangles[17];
  check_second_order(
      through,
      (surface.points[at(t[0])] + surface.points[at(t[1])] + surface.points[at(t[2])]) / 3);
}

TEST_CASE("at the border of an open smooth surface the nearest place is on the border") {
  const Triangulation saddle = mapped_grid(8, 8, false, false, [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Vec3(x, y, 0.4 * (x * x - y * y));
  });
  const SmoothSurface through = smooth(saddle);
  const SurfacePoint foot = through.nearest(Vec3(1.5, 0.13, 0.4));
  CHECK(foot.point.x() == doctest::Approx(1).epsilon(5e-3));
  CHECK(foot.point.y() == doctest::Approx(0.13).epsilon(0.05));
  // Normals of the paraboloid are exact at the border, too.
  const auto normals = point_normals(saddle, no_tangents(saddle));
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const Vec3& p = saddle.points[k];
    const bool border = std::max(std::abs(p.x()), std::abs(p.y())) > 1 - 1e-9;
    const Vec3 exact = Vec3(-0.8 * p.x(), 0.8 * p.y(), 1).normalized();
    CHECK((normals[k] - exact).norm() < (border ? 0.03 : 0.01));
  }
}

}  // namespace winslow::test
