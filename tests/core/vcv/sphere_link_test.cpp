#include "core/vcv/sphere/sphere_link.h"

#include <doctest/doctest.h>

#include <string>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/solid_angle.h"
#include "support/links.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

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
