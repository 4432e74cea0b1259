#include "core/vcv/sphere/solid_angle.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/links.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// L'Huilier: tan(Omega / 4)^2 = tan(s/2) tan((s-a)/2) tan((s-b)/2) tan((s-c)/2), s half the sum of
/// the sides, which are angles.
double by_sides(const Vec3& p, const Vec3& q, const Vec3& r) {
  const auto side = [](const Vec3& u, const Vec3& v) {
    return 2 * std::asin(std::min(1.0, 0.5 * (u - v).norm()));
  };
  const double a = side(q, r), b = side(r, p), c = side(p, q);
  const double s = 0.5 * (a + b + c);
  const double square = std::tan(0.5 * s) * std::tan(0.5 * (s - a)) * std::tan(0.5 * (s - b)) *
                        std::tan(0.5 * (s - c));
  return 4 * std::atan(std::sqrt(std::max(0.0, square)));
}

}  // namespace

TEST_CASE("the solid angle is the excess of the spherical triangle, with the sign of its turn") {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(solid_angle(x, y, z) == doctest::Approx(pi / 2));
  CHECK(solid_angle(y, x, z) == doctest::Approx(-pi / 2));
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const Vec3 a = random_direction(random), b = random_direction(random),
               c = random_direction(random);
    const double expected = by_sides(a, b, c);
    const double turn = a.dot(b.cross(c)) > 0 ? 1 : -1;
    CHECK(std::abs(solid_angle(a, b, c)) == doctest::Approx(expected).epsilon(1e-6));
    CHECK(solid_angle(a, b, c) * turn > 0);
    CHECK(solid_angle(b, c, a) == doctest::Approx(solid_angle(a, b, c)).epsilon(1e-12));
    CHECK(solid_angle(c, b, a) == doctest::Approx(-solid_angle(a, b, c)).epsilon(1e-12));
  }
}

TEST_CASE("a small triangle has the area of the plane one, and keeps its digits") {
  Random random(2);
  for (const double size : {1e-2, 1e-4, 1e-6}) {
    CAPTURE(size);
    const Vec3 a = random_direction(random);
    const Vec3 e = a.unitOrthogonal(), f = a.cross(e);
    const Vec3 b = (a + size * e).normalized(), c = (a + size * f).normalized();
    CHECK(solid_angle(a, b, c) == doctest::Approx(0.5 * size * size).epsilon(size + 1e-9));
  }
}

TEST_CASE("the derivatives of the solid angle agree with differences of it") {
  Random random(3);
  constexpr double step = 1e-5;
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    std::array<Vec3, 3> p{random_direction(random), random_direction(random),
                          random_direction(random)};
    // Across a half of the sphere the angle jumps from 2 pi to -2 pi.
    if (std::abs(solid_angle(p[0], p[1], p[2])) > 6) continue;
    if (std::abs(p[0].dot(p[1].cross(p[2]))) < 0.02) continue;
    const SolidAngleGradient g = solid_angle_gradient(p[0], p[1], p[2]);
    CHECK(g.angle == solid_angle(p[0], p[1], p[2]));
    const std::array<Vec3, 3> by{g.by_a, g.by_b, g.by_c};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 old = p[corner];
      const Vec3 along = old.unitOrthogonal();
      p[corner] = (old + step * along).normalized();
      const double after = solid_angle(p[0], p[1], p[2]);
      p[corner] = (old - step * along).normalized();
      const double before = solid_angle(p[0], p[1], p[2]);
      p[corner] = old;
      const double expected = (after - before) / (2 * step);
      CHECK(by[corner].dot(along) == doctest::Approx(expected).epsilon(1e-5).scale(1));
    }
  }
}

TEST_CASE("degenerate triangles have an angle of zero and finite derivatives") {
  const Vec3 x(1, 0, 0), y(0, 1, 0);
  CHECK(solid_angle(x, x, y) == 0);
  CHECK(solid_angle(x, x, x) == 0);
  const SolidAngleGradient opposite = solid_angle_gradient(x, -x, y);
  CHECK(opposite.by_a.allFinite());
  CHECK(opposite.by_c.allFinite());
}
