#include "core/mesh/corner_tetrahedra.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace winslow {

namespace {

std::vector<std::array<Index, 4>> make(ElementType type) {
  std::vector<std::array<Index, 4>> list;
  const auto links = shape_of(type).links;
  const std::size_t corners = type == ElementType::tetrahedron ? 1 : links.size();
  for (std::size_t k = 0; k < corners; ++k) {
    if (links[k].size() == 3)
      list.push_back({static_cast<Index>(k), links[k][0], links[k][1], links[k][2]});
  }
  return list;
}

bool are_linked(const ElementShape& shape, Index a, Index b) {
  const Face& link = shape.links[at(a)];
  return std::find(link.begin(), link.end(), b) != link.end();
}

/// The end of an edge at b in the face with (a, b) and (a, y); -1 if the face has three corners.
Index across(const ElementShape& shape, Index a, Index b, Index y) {
  for (const Index corner : shape.links[at(b)])
    if (corner != a && corner != y && are_linked(shape, corner, y)) return corner;
  return -1;
}

std::vector<std::array<Index, 4>> make_at_edges(ElementType type) {
  std::vector<std::array<Index, 4>> list;
  const ElementShape& shape = shape_of(type);
  if (type != ElementType::hexahedron && type != ElementType::prism) return list;
  for (const auto& [a, b] : shape.edges) {
    const Face& link = shape.links[at(a)];
    const auto place =
        static_cast<std::size_t>(std::find(link.begin(), link.end(), b) - link.begin());
    const Index y = link[(place + 1) % 3], z = link[(place + 2) % 3];
    if (are_linked(shape, b, y) || are_linked(shape, b, z)) continue;  // of a triangle
    list.push_back({a, b, y, across(shape, a, b, z)});
    list.push_back({a, b, across(shape, a, b, y), z});
  }
  return list;
}

}  // namespace

std::span<const std::array<Index, 4>> edge_tetrahedra(ElementType type) {
  static const auto hexahedron = make_at_edges(ElementType::hexahedron);
  static const auto prism = make_at_edges(ElementType::prism);
  if (type == ElementType::hexahedron) return hexahedron;
  if (type == ElementType::prism) return prism;
  return {};
}

std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type) {
  static const std::array<std::vector<std::array<Index, 4>>, 6> lists{
      {{},
       {},
       make(ElementType::tetrahedron),
       make(ElementType::pyramid),
       make(ElementType::prism),
       make(ElementType::hexahedron)}};
  return lists[static_cast<std::size_t>(type)];
}

std::span<const std::array<double, 3>> regular_corners(ElementType type) {
  using Corners = std::vector<std::array<double, 3>>;
  static const double half = 0.5, third = std::sqrt(3.0) / 6, high = std::sqrt(3.0) / 2;
  static const Corners tetrahedron{
      {0, 0, 0}, {1, 0, 0}, {half, high, 0}, {half, third, std::sqrt(2.0 / 3.0)}};
  static const Corners pyramid{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {half, half, std::sqrt(0.5)}};
  static const Corners prism{{0, 0, 0}, {1, 0, 0}, {half, high, 0},
                             {0, 0, 1}, {1, 0, 1}, {half, high, 1}};
  switch (type) {
    case ElementType::tetrahedron:
      return tetrahedron;
    case ElementType::pyramid:
      return pyramid;
    case ElementType::prism:
      return prism;
    default:
      return shape_of(type).corners;  // the unit cube
  }
}

namespace {

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

}  // namespace

double signed_area2(const Coordinates& x, std::span<const Index> corners) {
  const Vec2 o = x.xy(corners[0]);
  double sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec2 a = x.xy(corners[k]) - o;
    const Vec2 b = x.xy(corners[k + 1]) - o;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

double signed_volume6(const Coordinates& x, ElementType type, std::span<const Index> corners,
                      const Vec3& origin) {
  double sum = 0;
  for (const Face& face : shape_of(type).faces) {
    const Face nodes = by_nodes(face, corners);
    const Vec3 a = x.xyz(nodes[0]) - origin, b = x.xyz(nodes[1]) - origin,
               c = x.xyz(nodes[2]) - origin;
    if (nodes.size() == 3) {
      sum += triple(a, b, c);
      continue;
    }
    // The mean over both ways to cut the quadrilateral into triangles.
    const Vec3 d = x.xyz(nodes[3]) - origin;
    sum += 0.5 * (triple(a, b, c) + triple(a, c, d) + triple(a, b, d) + triple(b, c, d));
  }
  return sum;
}

}  // namespace winslow
