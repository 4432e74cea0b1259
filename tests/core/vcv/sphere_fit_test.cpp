#include <doctest/doctest.h>

#include <algorithm>

#include "core/error.h"
#include "core/vcv/sphere/sphere_fit.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/star_builder.h"
#include "support/links.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<Vec3> start_of(const SphereLink& link) {
  std::vector<Vec3> directions(at(link.vertex_count()));
  SphereStart().place(link, directions);
  return directions;
}

}  // namespace

TEST_CASE("every link starts on the unit sphere with all solid angles positive") {
  Random random(7);
  std::vector<Triangles> links{tetrahedron_link(), icosahedron(), subdivided(icosahedron()),
                               subdivided(subdivided(double_pyramid(4)))};
  for (Index n = 3; n <= 60; ++n) links.push_back(double_pyramid(n));
  for (int k = 0; k < 300; ++k) links.push_back(random_sphere(random, 4 + random.index(60), 300));
  for (int k = 0; k < 100; ++k) links.push_back(random_stack(random, 4 + random.index(30)));
  for (std::size_t k = 0; k < links.size(); ++k) {
    CAPTURE(k);
    const SphereLink link = link_of(links[k]);
    const auto directions = start_of(link);
    double sum = 0;
    for (const auto& [a, b, c] : link.triangles()) {
      const double angle = solid_angle(directions[at(a)], directions[at(b)], directions[at(c)]);
      CHECK(angle > 0);
      sum += angle;
    }
    CHECK(sum == doctest::Approx(4 * pi));
    for (const Vec3& d : directions) CHECK(d.norm() == doctest::Approx(1));
  }
}

TEST_CASE("the start of a regular solid is it, or near it") {
  const auto largest_error = [](const Triangles& triangles) {
    const SphereLink link = link_of(triangles);
    const std::vector<double> equal(triangles.size(), 4 * pi / link.triangle_count());
    return largest_angle_error(link, equal, start_of(link));
  };
  CHECK(largest_error(tetrahedron_link()) < 1e-9);
  CHECK(largest_error(double_pyramid(4)) < 0.05);
  CHECK(largest_error(icosahedron()) < 0.35);
}

TEST_CASE("a start that turns one triangle inside out, or covers the sphere twice, is told") {
  const SphereLink link = link_of(double_pyramid(6));
  auto directions = start_of(link);
  CHECK(covers_sphere(link, directions));
  std::swap(directions[0], directions[1]);
  CHECK_FALSE(covers_sphere(link, directions));
  // The ring goes around twice.
  directions.resize(8);
  for (Index k = 0; k < 6; ++k) {
    directions[at(k)] = Vec3(std::cos(2 * pi * k / 3), std::sin(2 * pi * k / 3), 0);
  }
  directions[6] = Vec3(0, 0, 1);
  directions[7] = Vec3(0, 0, -1);
  CHECK_FALSE(covers_sphere(link, directions));
}

TEST_CASE("triangles nested beyond what numbers can tell apart are refused") {
  Triangles triangles = tetrahedron_link();
  for (Index v = 4; v < 120; ++v) stack(triangles, 0, v);
  // Triangle 0 keeps its first two corners: the others lie deeper and deeper.
  const SphereLink link = link_of(triangles);
  std::vector<Vec3> directions(at(link.vertex_count()));
  bool placed = true;
  try {
    SphereStart().place(link, directions);
  } catch (const NumericError&) {
    placed = false;
  }
  CHECK(placed == covers_sphere(link, directions));
}

namespace {

struct Fitted {
  SphereLink link;
  std::vector<double> targets;
  std::vector<Vec3> directions;
  SphereFitResult result;
};

/// Equal angles, or those given.
Fitted fitted(const Triangles& triangles, const SphereFitOptions& options = {},
              std::vector<double> targets = {}) {
  Fitted f{link_of(triangles), std::move(targets), {}, {}};
  if (f.targets.empty()) {
    f.targets.assign(at(f.link.triangle_count()), 4 * pi / f.link.triangle_count());
  }
  f.directions.resize(at(f.link.vertex_count()));
  SphereStart().place(f.link, f.directions);
  f.result = SphereFit().fit(f.link, f.targets, options, f.directions);
  return f;
}

void check_reached(const Fitted& f) {
  CHECK(covers_sphere(f.link, f.directions));
  CHECK(f.result.end == SphereFitEnd::converged);
  CHECK(largest_angle_error(f.link, f.targets, f.directions) <= 1e-3);
  CHECK(f.result.largest_error ==
        doctest::Approx(largest_angle_error(f.link, f.targets, f.directions)));
}

}  // namespace

TEST_CASE("links of 4 to 80 triangles are given equal solid angles") {
  Random random(17);
  std::vector<Triangles> links{tetrahedron_link(),      double_pyramid(3),
                               double_pyramid(4),       double_pyramid(5),
                               icosahedron(),           even_sphere(random, 13),
                               even_sphere(random, 22), even_sphere(random, 42)};
  for (const Triangles& triangles : links) {
    CAPTURE(triangles.size());
    check_reached(fitted(triangles));
  }
}

TEST_CASE("fans of up to 72 elements around an edge are given equal solid angles") {
  for (Index n = 6; n <= 72; n += 6) {
    CAPTURE(n);
    check_reached(fitted(double_pyramid(n)));
  }
}

TEST_CASE("solid angles of a sphere that exists are found again from its connectivity alone") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Fitted equal = fitted(even_sphere(random, 8 + random.index(12)));
    std::vector<Vec3> shaken = equal.directions;
    for (Vec3& d : shaken) d = (d + 0.1 * random_direction(random)).normalized();
    if (!covers_sphere(equal.link, shaken)) continue;
    std::vector<double> targets;
    for (const auto& [a, b, c] : equal.link.triangles()) {
      targets.push_back(solid_angle(shaken[at(a)], shaken[at(b)], shaken[at(c)]));
    }
    equal.targets = targets;
    equal.result = SphereFit().fit(equal.link, targets, {}, equal.directions);
    check_reached(equal);
  }
}

TEST_CASE("random triangulations are never inverted, and say why where angles are missed") {
  struct Count {
    Index reached = 0, limited = 0;
  };
  const auto fit_all = [](bool even, double least_shape) {
    Random random(19);
    SphereFitOptions options;
    options.least_shape = least_shape;
    Count count;
    for (int k = 0; k < 200; ++k) {
      CAPTURE(k);
      const Index n = 5 + random.index(30);
      const Fitted f =
          fitted(even ? even_sphere(random, n) : random_sphere(random, n, 300), options);
      CHECK(covers_sphere(f.link, f.directions));
      const double error = largest_angle_error(f.link, f.targets, f.directions);
      CHECK((error <= 1e-3) == (f.result.end == SphereFitEnd::converged));
      count.reached += f.result.end == SphereFitEnd::converged;
      count.limited += f.result.end == SphereFitEnd::limited_by_shape;
    }
    return count;
  };
  const Count even = fit_all(true, 0.2), random = fit_all(false, 0.2), flat = fit_all(false, 0);
  CHECK(even.reached >= 160);
  CHECK(even.reached + even.limited >= 195);
  CHECK(random.reached < even.reached);
  CHECK(random.reached + random.limited >= 190);
  CHECK(flat.reached > random.reached);
}

TEST_CASE("a link whose symmetry leaves angles no freedom comes near them") {
  // Of the 80 triangles 20 have three corners of 6 neighbours, 60 one of 5.
  const Fitted f = fitted(subdivided(icosahedron()));
  CHECK(covers_sphere(f.link, f.directions));
  CHECK(f.result.end != SphereFitEnd::converged);
  CHECK(f.result.largest_error < 0.03);
}

TEST_CASE("regularisation trades solid angles for shape") {
  Random random(23);
  const Triangles triangles = even_sphere(random, 16);
  SphereFitOptions soft;
  soft.least_regularisation = soft.regularisation = 1;
  const Fitted exact = fitted(triangles), shaped = fitted(triangles, soft);
  CHECK(shaped.result.end == SphereFitEnd::limited_by_shape);
  CHECK(covers_sphere(shaped.link, shaped.directions));
  CHECK(shaped.result.largest_error > exact.result.largest_error);
  const auto edges = [](const Fitted& f) {
    double sum = 0;
    for (const auto& [a, b, c] : f.link.triangles()) {
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        sum += (f.directions[at(p)] - f.directions[at(q)]).squaredNorm();
      }
    }
    return sum;
  };
  CHECK(edges(shaped) < edges(exact));
}

TEST_CASE("a fit without a valid start is refused, and one without steps leaves it alone") {
  const SphereLink link = link_of(double_pyramid(5));
  std::vector<Vec3> directions(7, Vec3(1, 0, 0));
  const std::vector<double> targets(10, 0.4 * pi);
  CHECK_THROWS_AS(SphereFit().fit(link, targets, {}, directions), UsageError);
  SphereStart().place(link, directions);
  const auto before = directions;
  SphereFitOptions none;
  none.most_steps = 0;
  none.tolerance = 0;
  CHECK(SphereFit().fit(link, targets, none, directions).end == SphereFitEnd::out_of_steps);
  CHECK(directions == before);
}
