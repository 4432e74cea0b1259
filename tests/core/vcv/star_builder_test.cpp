#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/vcv/sphere/sphere_fit.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/star_builder.h"
#include "support/links.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("the aspect ratio is 1 of the regular tetrahedron and R / (3 r) of others") {
  const Vec3 a(1, 1, 0), b(0, 1, 1), c(1, 0, 1);
  const double sign = a.dot(b.cross(c)) > 0 ? 1 : -1;
  REQUIRE(sign == 1);
  CHECK(tetrahedron_aspect_ratio(a, b, c) == doctest::Approx(1));
  Random random(11);
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    const Vec3 p = random_direction(random), q = 2 * random_direction(random),
               r = 3 * random_direction(random);
    if (p.dot(q.cross(r)) < 0.05) continue;
    Eigen::Matrix3d rows;
    rows << p.transpose(), q.transpose(), r.transpose();
    const Vec3 centre =
        rows.lu().solve(0.5 * Vec3(p.squaredNorm(), q.squaredNorm(), r.squaredNorm()));
    const auto area = [](const Vec3& u, const Vec3& v) { return 0.5 * u.cross(v).norm(); };
    const double surface = area(p, q) + area(q, r) + area(r, p) + area(q - p, r - p);
    const double inradius = 3 * (rows.determinant() / 6) / surface;
    CHECK(tetrahedron_aspect_ratio(p, q, r) == doctest::Approx(centre.norm() / (3 * inradius)));
  }
  CHECK(std::isinf(tetrahedron_aspect_ratio(a, b, 0.5 * (a + b))));
}

TEST_CASE("the cost punishes inversion, bad shape and angles off on either side") {
  const double s = std::sqrt(0.5);
  const Vec3 a(s, s, 0), b(0, s, s), c(s, 0, s);
  const double own = solid_angle(a, b, c);
  CHECK(tetrahedron_cost(a, b, c, own) == doctest::Approx(0).scale(1));
  CHECK(tetrahedron_cost(a, b, c, own + 0.1) == doctest::Approx(1 - 1 / 1.21));
  CHECK(tetrahedron_cost(a, b, c, own - 0.1) == doctest::Approx(1 - 1 / 1.21));
  CHECK(tetrahedron_cost(c, b, a, own) == doctest::Approx(1 + a.dot(b.cross(c))));
  CHECK(tetrahedron_cost(a, b, (a + b).normalized(), own) == doctest::Approx(1));
}

TEST_CASE("the cost of a vertex blends the largest and the mean") {
  BlendedCost cost;
  cost.add(0.5);
  cost.add(0.1);
  const double r = 0.125, mean = (0.25 + 0.01) / 2;
  CHECK(cost.value() == doctest::Approx(r * 0.5 + (1 - r) * mean));
  cost.add(1.5);  // an inverted one: r is larger than 1
  CHECK(cost.value() == doctest::Approx(1.5 * 1.5 * 1.5 * 1.5));
}

TEST_CASE("perturbation lowers the cost of a star, inverts nothing, and repeats itself") {
  Random random(13);
  SphereStart start;
  for (int k = 0; k < 5; ++k) {
    CAPTURE(k);
    const SphereLink link = link_of(random_sphere(random, 13, 60));
    std::vector<Vec3> before(13);
    start.place(link, before);
    StarTargets equal;
    const auto targets = equal.equal(link);
    auto first = before, second = before, other = before;
    const int sweeps = perturb_directions(link, targets, {}, 5, first);
    CHECK(sweeps > 0);
    perturb_directions(link, targets, {}, 5, second);
    perturb_directions(link, targets, {}, 6, other);
    CHECK(first == second);
    CHECK(first != other);
    CHECK(covers_sphere(link, first));
    CHECK(star_cost(link, targets, first).max < star_cost(link, targets, before).max);
    CHECK(largest_angle_error(link, targets, first) < largest_angle_error(link, targets, before));
  }
}
