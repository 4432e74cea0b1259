#include "core/mesh/element_type.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/quality/volume_element.h"
#include "core/types.h"
#include "support/random.h"

using namespace winslow;

namespace {

Vec3 corner(const ElementShape& shape, Index k) {
  const auto& p = shape.corners[at(k)];
  return {p[0], p[1], p[2]};
}

template <typename Corners>
Vec3 centre(const ElementShape& shape, const Corners& corners) {
  Vec3 sum(0, 0, 0);
  for (const Index k : corners) sum += corner(shape, k);
  return sum / static_cast<double>(corners.size());
}

Vec3 centre(const ElementShape& shape) {
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 0; k < shape.corners.size(); ++k)
    sum += corner(shape, static_cast<Index>(k));
  return sum / static_cast<double>(shape.corners.size());
}

/// Area times outward normal of a flat polygon, or length times the normal on the right of an edge.
Vec3 area_vector(const ElementShape& shape, const Face& face) {
  const Vec3 o = corner(shape, face[0]);
  if (face.size() == 2) {
    const Vec3 d = corner(shape, face[1]) - o;
    return {d.y(), -d.x(), 0};
  }
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    sum += 0.5 * (corner(shape, face[k]) - o).cross(corner(shape, face[k + 1]) - o);
  }
  return sum;
}

/// Area or volume by the divergence theorem: a part of the flux of the position through the faces.
double measure(const ElementShape& shape, const std::vector<Face>& faces) {
  double flux = 0;
  for (const Face& face : faces) flux += area_vector(shape, face).dot(centre(shape, face));
  return flux / shape.dimension;
}

std::vector<Face> faces_of(const ElementShape& shape) {
  return {shape.faces.begin(), shape.faces.end()};
}

std::set<std::set<Index>> edges_of(const ElementShape& shape) {
  std::set<std::set<Index>> edges;
  for (const auto& [a, b] : shape.edges) edges.insert({a, b});
  return edges;
}

}  // namespace

TEST_CASE("element types have the numbers of corners, edges and faces that they are known for") {
  struct Known {
    ElementType type;
    std::string_view name;
    int dimension;
    std::size_t corners, edges, faces;
    double measure;
  };
  const std::vector<Known> known{{ElementType::triangle, "triangle", 2, 3, 3, 3, 0.5},
                                 {ElementType::quadrilateral, "quadrilateral", 2, 4, 4, 4, 1},
                                 {ElementType::tetrahedron, "tetrahedron", 3, 4, 6, 4, 1 / 6.0},
                                 {ElementType::pyramid, "pyramid", 3, 5, 8, 5, 1 / 3.0},
                                 {ElementType::prism, "prism", 3, 6, 9, 5, 0.5},
                                 {ElementType::hexahedron, "hexahedron", 3, 8, 12, 6, 1}};
  CHECK(known.size() == fixed_element_types.size());
  for (const Known& k : known) {
    CAPTURE(k.name);
    const ElementShape& shape = shape_of(k.type);
    CHECK(shape.name == k.name);
    CHECK(shape.dimension == k.dimension);
    CHECK(dimension_of(k.type) == k.dimension);
    CHECK(shape.corners.size() == k.corners);
    CHECK(corner_count(k.type) == static_cast<Index>(k.corners));
    CHECK(shape.links.size() == k.corners);
    CHECK(shape.mirrored.size() == k.corners);
    CHECK(shape.edges.size() == k.edges);
    CHECK(edges_of(shape).size() == k.edges);
    CHECK(shape.faces.size() == k.faces);
    CHECK(measure(shape, faces_of(shape)) == doctest::Approx(k.measure).epsilon(1e-14));
  }
}

TEST_CASE("faces are flat, convex, and seen from outside counter-clockwise") {
  for (const ElementType type : fixed_element_types) {
    const ElementShape& shape = shape_of(type);
    CAPTURE(shape.name);
    for (const Face& face : shape.faces) {
      CAPTURE(nodes_text(face));
      const Vec3 normal = area_vector(shape, face);
      CHECK(normal.dot(centre(shape, face) - centre(shape)) > 0);
      if (face.size() == 2) continue;
      const std::size_t n = face.size();
      for (std::size_t k = 0; k < n; ++k) {
        const Vec3 p = corner(shape, face[k]);
        const Vec3 next = corner(shape, face[(k + 1) % n]) - p;
        const Vec3 previous = corner(shape, face[(k + n - 1) % n]) - p;
        CHECK(next.dot(normal) == doctest::Approx(0));
        CHECK(next.cross(previous).dot(normal) > 0);
      }
    }
  }
}

TEST_CASE("faces close: each edge is in exactly two, once in each direction; Euler's formula") {
  for (const ElementType type : fixed_element_types) {
    const ElementShape& shape = shape_of(type);
    CAPTURE(shape.name);
    const auto corners = static_cast<int>(shape.corners.size());
    const auto edges = static_cast<int>(shape.edges.size());
    const auto faces = static_cast<int>(shape.faces.size());
    if (shape.dimension == 2) {
      CHECK(corners - edges == 0);
      for (std::size_t k = 0; k < shape.edges.size(); ++k) {
        CHECK(shape.faces[k].edge() == shape.edges[k]);
      }
      continue;
    }
    CHECK(corners - edges + faces == 2);
    std::map<std::pair<Index, Index>, int> directed;
    for (const Face& face : shape.faces) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        ++directed[{face[k], face[(k + 1) % face.size()]}];
      }
    }
    CHECK(directed.size() == 2 * shape.edges.size());
    for (const auto& [a, b] : shape.edges) {
      CHECK(directed[{a, b}] == 1);
      CHECK(directed[{b, a}] == 1);
    }
  }
}

TEST_CASE("links hold the ends of the edges at a corner, in the order that faces away from it") {
  for (const ElementType type : fixed_element_types) {
    const ElementShape& shape = shape_of(type);
    CAPTURE(shape.name);
    for (std::size_t k = 0; k < shape.corners.size(); ++k) {
      CAPTURE(k);
      const auto own = static_cast<Index>(k);
      const Face& link = shape.links[k];
      std::set<Index> ends;
      for (const auto& edge : edges_of(shape)) {
        if (!edge.contains(own)) continue;
        for (const Index end : edge) {
          if (end != own) ends.insert(end);
        }
      }
      CHECK(std::set<Index>(link.begin(), link.end()) == ends);
      const Vec3 p = corner(shape, own);
      for (std::size_t m = 0; m < link.size(); ++m) {
        const Index a = link[m], b = link[(m + 1) % link.size()];
        const Vec3 turn = (corner(shape, a) - p).cross(corner(shape, b) - p);
        if (shape.dimension == 2) {
          if (m == 0) CHECK(turn.z() > 0);
          continue;
        }
        // Two neighbours in the link have a face of the element between them.
        CHECK(std::any_of(shape.faces.begin(), shape.faces.end(), [&](const Face& face) {
          const auto has = [&](Index i) {
            return std::find(face.begin(), face.end(), i) != face.end();
          };
          return has(own) && has(a) && has(b);
        }));
        CHECK(turn.dot(centre(shape) - p) > 0);
      }
    }
  }
}

TEST_CASE("a mirrored element is turned inside out: the same faces from the other side") {
  for (const ElementType type : fixed_element_types) {
    const ElementShape& shape = shape_of(type);
    CAPTURE(shape.name);
    CHECK(shape.mirrored[0] == 0);
    std::vector<Face> mirrored;
    std::set<Face> before, after;
    for (std::size_t k = 0; k < shape.corners.size(); ++k) {
      CHECK(shape.mirrored[at(shape.mirrored[k])] == static_cast<Index>(k));
    }
    for (const Face& face : shape.faces) {
      mirrored.push_back(by_nodes(face, shape.mirrored));
      before.insert(face.sorted());
      after.insert(mirrored.back().sorted());
    }
    CHECK(before == after);
    CHECK(measure(shape, mirrored) == doctest::Approx(-measure(shape, faces_of(shape))));
  }
}

TEST_CASE("a face is a few nodes in cyclic order") {
  const std::vector<Index> nodes{7, 3, 9, 1};
  const Face quad{std::span<const Index>(nodes)};
  CHECK(quad == Face(7, 3, 9, 1));
  CHECK(quad.size() == 4);
  CHECK(quad.sorted() == Face(1, 3, 7, 9));
  CHECK(quad.reversed() == Face(7, 1, 9, 3));
  CHECK(Face(5, 2, 8).sorted() == Face(2, 5, 8));
  CHECK(Face(5, 2, 8).reversed() == Face(5, 8, 2));
  CHECK(Face(5, 2).reversed() == Face(2, 5));
  CHECK(Face(5, 2).edge() == std::array<Index, 2>{5, 2});
  CHECK(nodes_text(quad) == "nodes 7, 3, 9 and 1");
  CHECK(nodes_text(Face(5, 2)) == "nodes 5 and 2");
  CHECK_THROWS_WITH_AS(
      quad.edge(),
      "a face with nodes 7, 3, 9 and 1 where an edge of a plane or surface mesh is expected",
      UsageError);
  CHECK_THROWS_AS(Face(std::span<const Index>(nodes).first(1)), UsageError);
  const std::vector<Index> many{4, 9, 2, 7, 1, 8};
  Face face{std::span<const Index>(many)};
  const Face copy = face;
  CHECK(std::ranges::equal(copy, many));
  CHECK(std::ranges::equal(face.sorted(), std::vector<Index>{1, 2, 4, 7, 8, 9}));
  CHECK(std::ranges::equal(face.reversed(), std::vector<Index>{4, 8, 1, 7, 2, 9}));
  CHECK(face.sorted() == face.reversed().sorted());
  face = Face(1, 2, 3);
  CHECK(face.size() == 3);
  CHECK(copy.size() == 6);
  face = copy;
  CHECK(face == copy);
  CHECK(Face(1, 2, 3) < Face(1, 2, 3, 4));
  CHECK(Face(1, 2, 3, 4) < Face(1, 2, 4));
  const Face moved = std::move(face);
  CHECK(moved == copy);
}

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
