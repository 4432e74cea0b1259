#include "core/mesh/corner_tetrahedra.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/quality/volume_element.h"
#include "support/random.h"

namespace winslow::test {
namespace {

/// Where the map of a hexahedron or a prism takes a place of its reference element.
Vec3 map_to(ElementType type, const std::array<Vec3, 8>& x, const Vec3& at_place) {
  const double r = at_place.x(), s = at_place.y(), t = at_place.z();
  const auto between = [&](std::size_t below, std::size_t above) {
    return Vec3((1 - t) * x[below] + t * x[above]);
  };
  if (type == ElementType::prism)
    return (1 - r - s) * between(0, 3) + r * between(1, 4) + s * between(2, 5);
  return (1 - s) * ((1 - r) * between(0, 4) + r * between(1, 5)) +
         s * ((1 - r) * between(3, 7) + r * between(2, 6));
}

/// The map is linear in each direction: differences are its derivatives.
double jacobian(ElementType type, const std::array<Vec3, 8>& x, const Vec3& place) {
  Eigen::Matrix3d j;
  for (int k = 0; k < 3; ++k)
    j.col(k) =
        map_to(type, x, place + 0.5 * Vec3::Unit(k)) - map_to(type, x, place - 0.5 * Vec3::Unit(k));
  return j.determinant();
}

double determinant(const std::array<Vec3, 8>& x, const std::array<Index, 4>& nodes) {
  return VolumeCorner(x[at(nodes[0])], x[at(nodes[1])], x[at(nodes[2])], x[at(nodes[3])])
      .determinant;
}

}  // namespace

TEST_CASE("two tetrahedra of an edge make up the Jacobian's coefficient along it") {
  CHECK(edge_tetrahedra(ElementType::hexahedron).size() == 24);
  CHECK(edge_tetrahedra(ElementType::prism).size() == 6);
  CHECK(edge_tetrahedra(ElementType::tetrahedron).empty());
  CHECK(edge_tetrahedra(ElementType::pyramid).empty());
  Random random(11);
  for (const ElementType type : {ElementType::hexahedron, ElementType::prism}) {
    const auto corners = shape_of(type).corners;
    const auto place = [&](Index corner) { return Vec3(corners[at(corner)].data()); };
    const auto list = edge_tetrahedra(type);
    for (int sample = 0; sample < 20; ++sample) {
      std::array<Vec3, 8> x;
      for (Vec3& p : x)
        p = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      for (std::size_t k = 0; k < list.size(); k += 2) {
        const Index a = list[k][0], b = list[k][1];
        REQUIRE(list[k + 1][0] == a);
        REQUIRE(list[k + 1][1] == b);
        const double middle = jacobian(type, x, 0.5 * (place(a) + place(b)));
        const double coefficient =
            2 * middle - 0.5 * (jacobian(type, x, place(a)) + jacobian(type, x, place(b)));
        const double sum = determinant(x, list[k]) + determinant(x, list[k + 1]);
        CHECK(std::abs(sum - 2 * coefficient) < 1e-12);
      }
    }
  }
}

}  // namespace winslow::test
