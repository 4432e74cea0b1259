#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/sphere_link.h"
#include "support/links.h"
#include "support/space_meshes.h"

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

namespace {

std::string refusal(Index vertices, const Triangles& triangles) {
  try {
    const SphereLink link(vertices, triangles);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

bool says(const std::string& message, const std::string& text) {
  CAPTURE(message);
  CHECK(message.find(text) != std::string::npos);
  return message.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("half-edges of a link lead to the triangle on the other side and back") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Index n = 4 + random.index(30);
    const SphereLink link = link_of(random_sphere(random, n, 200));
    CHECK(link.vertex_count() == n);
    CHECK(link.triangle_count() == 2 * n - 4);
    Index half_edges = 0;
    for (Index v = 0; v < n; ++v) {
      CHECK(link.degree(v) >= 3);
      for (const Index h : link.outgoing(v)) {
        CHECK(link.start_of(h) == v);
        CHECK(link.start_of(link.twin(h)) == link.end_of(h));
        CHECK(link.end_of(link.twin(h)) == v);
        CHECK(link.twin(link.twin(h)) == h);
        ++half_edges;
      }
    }
    CHECK(half_edges == 3 * link.triangle_count());
  }
}

TEST_CASE("triangles that make no sphere are refused, with the reason") {
  Triangles open = double_pyramid(5);
  open.pop_back();
  says(refusal(7, open), "has a triangle on one side only");
  Triangles turned = double_pyramid(5);
  std::swap(turned[3][0], turned[3][1]);
  says(refusal(7, turned), "has a triangle on one side only");
  Triangles doubled = double_pyramid(5);
  doubled.push_back(doubled.front());
  says(refusal(7, doubled), "has two triangles on one side");
  says(refusal(3, {{0, 1, 2}, {2, 1, 0}}), "found 3 vertices, expected at least 4");
  says(refusal(8, double_pyramid(5)), "vertex 7 has no triangle");
  says(refusal(6, double_pyramid(5)), "there is no vertex 6");
  says(refusal(7, {{0, 0, 1}}), "a triangle has vertex 0 twice");

  Triangles two = tetrahedron_link();
  for (auto triangle : tetrahedron_link()) {
    for (Index& v : triangle) v += 4;
    two.push_back(triangle);
  }
  says(refusal(8, two), "it has several parts");
  for (auto& triangle : two) {
    for (Index& v : triangle) {
      if (v >= 4) v = v == 4 ? 0 : v - 1;
    }
  }
  says(refusal(7, two), "two parts meet in vertex 0");

  // A torus of 3 by 3 squares.
  Triangles torus;
  const auto id = [](Index i, Index j) { return 3 * (j % 3) + i % 3; };
  for (Index j = 0; j < 3; ++j) {
    for (Index i = 0; i < 3; ++i) {
      torus.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      torus.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  says(refusal(9, torus), "found 18 triangles for 9 vertices, expected 14");
}

TEST_CASE("links of interior nodes are spheres around them, seen from outside") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Random random(5);
    const Mesh mesh = make_mesh(shuffled_volume(cube(4, volumes), random, true));
    const Topology& topology = *mesh.topology;
    REQUIRE(!topology.interior_nodes().empty());
    for (const Index node : topology.interior_nodes()) {
      const SphereLink link(topology, node);
      const auto neighbours = topology.neighbours(node);
      CHECK(link.vertex_count() == static_cast<Index>(neighbours.size()));
      double sum = 0;
      const auto direction = [&](Index v) {
        return Vec3(
            (mesh.coordinates.xyz(neighbours[at(v)]) - mesh.coordinates.xyz(node)).normalized());
      };
      for (const auto& [a, b, c] : link.triangles()) {
        const double angle = solid_angle(direction(a), direction(b), direction(c));
        CHECK(angle > 0);
        sum += angle;
      }
      CHECK(sum == doctest::Approx(4 * pi));
    }
  }
}

TEST_CASE("a node of the boundary has no closed link") {
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  CHECK_THROWS_AS(SphereLink(*mesh.topology, 0), UsageError);
  CHECK_THROWS_AS(SphereLink(*mesh.topology, -1), UsageError);
  CHECK_THROWS_AS(SphereLink(*mesh.topology, mesh.topology->node_count()), UsageError);
}
