#include "core/inspect/space/section_index.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/inspect/space/plane_section.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Polygon = std::pair<Index, std::vector<std::array<double, 3>>>;

/// The polygons with their places, in an order of their own.
std::vector<Polygon> polygons_of(const PlaneSection& section) {
  std::vector<Polygon> all;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    Polygon polygon{section.elements[at(k)], {}};
    for (const Index point : section.polygons[k]) {
      const Vec3& p = section.points[at(point)];
      polygon.second.push_back({p.x(), p.y(), p.z()});
    }
    std::rotate(polygon.second.begin(), std::ranges::min_element(polygon.second),
                polygon.second.end());
    all.push_back(std::move(polygon));
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("an index gives the same polygons, for every kind of element and place of the plane") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Random random(11);
    Mesh mesh = make_mesh(shuffled_volume(cube(6, volumes), random, false));
    const SectionIndex given(mesh);
    for (const Index node : mesh.topology->interior_nodes())
      mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.02 * random_vector(random));
    const SectionIndex moved(mesh, given);
    std::vector<Plane> planes{Plane({0.5, 0.5, 0.5}, {0, 0, 1}), Plane({0, 0, 0}, {0, 0, 1}),
                              Plane({0, 0, 1}, {0, 0, 1}), Plane({3, 0, 0}, {1, 0, 0}),
                              Plane({1, 0.2, 0.3}, {1, 0, 0})};
    for (int k = 0; k < 20; ++k)
      planes.emplace_back(Vec3::Constant(0.5) + 0.5 * random_vector(random), random_vector(random));
    for (const Plane& plane : planes) {
      const PlaneSection plain = plane_section(mesh, plane);
      const PlaneSection indexed = plane_section(mesh, plane, &moved);
      CHECK(plain.points.size() == indexed.points.size());
      CHECK(polygons_of(plain) == polygons_of(indexed));
    }
  }
}

TEST_CASE("what a plane meets is near it in the index, and what is far is left out") {
  const Mesh mesh = shaken_box(12, 0.2, 5);
  const SectionIndex index(mesh);
  CHECK(index.extent() == space_bounds(mesh));
  const Plane plane({0.5, 0.5, 0.31}, {0.1, 0.2, 1});
  const std::vector<Index> near = index.near(plane, 0);
  std::vector<unsigned char> is_near(at(mesh.topology->element_count()), 0);
  for (const Index e : near) is_near[at(index.order().elements[at(e)])] = 1;
  for (const Index e : plane_section(mesh, plane).elements) CHECK(is_near[at(e)] == 1);
  CHECK(near.size() < 0.7 * static_cast<double>(is_near.size()));
  CHECK(index.near(Plane({0, 0, 5}, {0, 0, 1}), 0).empty());
  // A node or an element that was forgotten would leave a hole.
  std::vector<Index> all = index.order().elements;
  std::ranges::sort(all);
  for (std::size_t k = 0; k < all.size(); ++k) CHECK(all[k] == static_cast<Index>(k));
}

TEST_CASE("an index of a plane mesh, or for another mesh, is refused") {
  CHECK_THROWS_AS(SectionIndex(make_mesh(square(4, Cells::triangles))), UsageError);
  const SectionIndex index(shaken_box(3, 0, 1));
  CHECK_THROWS_AS(SectionIndex(shaken_box(4, 0, 1), index), UsageError);
}
