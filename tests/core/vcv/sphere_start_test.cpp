#include "core/vcv/sphere/sphere_start.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/error.h"
#include "core/vcv/sphere/solid_angle.h"
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
