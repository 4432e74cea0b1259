#include "core/vcv/sphere/link_matching.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/vcv/sphere/node_vcv.h"
#include "support/links.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<Vec3> random_directions(Random& random, Index count) {
  std::vector<Vec3> directions;
  for (Index k = 0; k < count; ++k) directions.push_back(random_vector(random).normalized());
  return directions;
}

/// Triangles in other places of the list, turned, with other numbers for their vertices.
Triangles renumbered(Random& random, const Triangles& triangles, const std::vector<Index>& number) {
  Triangles out;
  for (const Index t : random.permutation(static_cast<Index>(triangles.size()))) {
    SphereLink::Triangle triangle = triangles[at(t)];
    std::rotate(triangle.begin(), triangle.begin() + random.index(3), triangle.end());
    for (Index& vertex : triangle) vertex = number[at(vertex)];
    out.push_back(triangle);
  }
  return out;
}

}  // namespace

TEST_CASE("a link with other numbers is found to be the same, and which vertex is which") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // Regular links, too, which go onto themselves in many ways: directions tell which is meant.
    const Triangles triangles =
        seed % 4 == 0 ? double_pyramid(6) : random_sphere(random, 5 + random.index(20), 100);
    const SphereLink from = link_of(triangles);
    const std::vector<Index> number = random.permutation(from.vertex_count());
    const SphereLink to = link_of(renumbered(random, triangles, number));
    const std::vector<Vec3> there = random_directions(random, from.vertex_count());
    std::vector<Vec3> here(there.size());
    for (std::size_t k = 0; k < there.size(); ++k) here[at(number[k])] = there[k];
    const auto vertices = match_links(from, there, to, here);
    REQUIRE(vertices.has_value());
    CHECK(*vertices == number);
  }
}

TEST_CASE("links that are not the same graph do not match, nor do mirror images") {
  Random random(7);
  const std::vector<Vec3> any = random_directions(random, 40);
  const auto match = [&](const Triangles& a, const Triangles& b) {
    return match_links(link_of(a), any, link_of(b), any).has_value();
  };
  CHECK_FALSE(match(double_pyramid(5), double_pyramid(6)));
  // As many vertices and triangles, other degrees.
  CHECK_FALSE(match(double_pyramid(6), random_sphere(random, 8, 100)));
  // A sphere without symmetry, and its image in a mirror.
  bool found = false;
  for (std::uint64_t seed = 1; seed < 40 && !found; ++seed) {
    Random other(seed);
    const Triangles triangles = random_sphere(other, 9, 100);
    Triangles mirrored = triangles;
    for (auto& [a, b, c] : mirrored) std::swap(b, c);
    CHECK(match(triangles, triangles));
    found = !match(triangles, mirrored);
  }
  CHECK(found);
}

TEST_CASE("in a grid all inner nodes have one link, and edges that point the same way match") {
  const Mesh mesh = shaken_box(4, 0.1, 3);
  const auto interior = mesh.topology->interior_nodes();
  const Index source = interior[13];
  const auto stars = matching_stars(mesh, source, interior);
  CHECK(stars.size() == interior.size() - 1);
  const auto own = mesh.topology->neighbours(source);
  for (const auto& [node, neighbours] : stars) {
    REQUIRE(neighbours.size() == own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      const Vec3 there = mesh.coordinates.xyz(own[k]) - mesh.coordinates.xyz(source);
      const Vec3 here = mesh.coordinates.xyz(neighbours[k]) - mesh.coordinates.xyz(node);
      CHECK((here - there).norm() < 0.15);
    }
  }
  // Their VCVs are valid ones: what is refused would say so.
  SphereStencil stencil;
  for (const Index k : own) {
    stencil.directions.push_back(
        (mesh.coordinates.xyz(k) - mesh.coordinates.xyz(source)).normalized());
    stencil.lengths.push_back(1.5);
  }
  const auto edits = spread_vcv(stencil, stars);
  const auto stencils = edit_vcvs(*mesh.topology, nullptr, edits);
  REQUIRE(stencils != nullptr);
  CHECK(stencils->size() == stars.size());
}

TEST_CASE("nodes of the boundary, with another link or beyond recall are left out") {
  const Mesh mesh = make_mesh(cube(5, Volumes::mixed));
  const auto interior = mesh.topology->interior_nodes();
  const Index source = interior.back();  // among tetrahedra; hexahedra below
  std::vector<Index> all(at(mesh.coordinates.size()));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) all[at(i)] = i;
  const auto stars = matching_stars(mesh, source, all);
  CHECK(stars.size() < interior.size() - 1);
  for (const auto& star : stars) CHECK_FALSE(mesh.topology->on_boundary(star.node));
  const std::atomic<bool> stop = true;
  CHECK(matching_stars(mesh, source, all, &stop).empty());
  Index outside = 0;
  while (!mesh.topology->on_boundary(outside)) ++outside;
  CHECK_THROWS_AS(matching_stars(mesh, outside, all), Error);
}
