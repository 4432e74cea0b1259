#include "core/geometry/surface/triangulation.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "core/mesh/index_sets.h"
#include "core/mesh/polygon.h"

namespace winslow {

namespace {

/// The triangles around each point.
CompressedRows triangles_at(const Triangulation& surface) {
  return rows_of(static_cast<Index>(surface.points.size()), [&](const auto& add) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      for (const Index p : surface.triangles[t]) add(p, static_cast<Index>(t));
  });
}

/// Points of the triangles around a point and of the triangles around these points, without the
/// point itself.
std::vector<Index> points_around(const Triangulation& surface, const CompressedRows& star,
                                 Index point) {
  std::vector<Index> ring, out;
  for (const Index t : star[point])
    for (const Index p : surface.triangles[at(t)]) ring.push_back(p);
  for (const Index q : ring)
    for (const Index t : star[q])
      for (const Index p : surface.triangles[at(t)])
        if (p != point) out.push_back(p);
  sort_unique(out);
  return out;
}

/// Normal of the paraboloid z = a x + b y + c x^2 + d x y + e y^2 through the points around, by
/// least squares. z is along the rough normal, which is returned if the points do not determine a
/// paraboloid.
Vec3 paraboloid_normal(const Triangulation& surface, const CompressedRows& star, Index point,
                       const Vec3& rough) {
  const std::vector<Index> around = points_around(surface, star, point);
  constexpr std::size_t least = 6;
  if (around.size() < least) return rough;
  const Vec3 first = rough.unitOrthogonal(), second = rough.cross(first);
  const Vec3 origin = surface.points[at(point)];
  double reach = 0;
  for (const Index p : around) reach = std::max(reach, (surface.points[at(p)] - origin).norm());
  Eigen::Matrix<double, Eigen::Dynamic, 5> rows(static_cast<Eigen::Index>(around.size()), 5);
  Eigen::VectorXd heights(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Vec3 arm = (surface.points[at(around[static_cast<std::size_t>(i)])] - origin) / reach;
    const double x = first.dot(arm), y = second.dot(arm);
    const double weight = 1 / (0.05 + x * x + y * y);
    rows.row(i) << x, y, x * x, x * y, y * y;
    rows.row(i) *= weight;
    heights[i] = weight * rough.dot(arm);
  }
  const Eigen::ColPivHouseholderQR<decltype(rows)> qr(rows);
  if (qr.rank() < 5) return rough;
  const Eigen::VectorXd fit = qr.solve(heights);
  const Vec3 normal = (rough - fit[0] * first - fit[1] * second).normalized();
  constexpr double least_cosine = 0.94;  // 20 degrees
  return normal.dot(rough) > least_cosine ? normal : rough;
}

}  // namespace

std::vector<std::array<Index, 3>> triangles_of(const SpacePoints& x, std::span<const Index> f) {
  if (f.size() == 3) return {{0, 1, 2}};
  if (f.size() > 4) {
    std::vector<Vec3> places;
    for (const Index node : f) places.push_back(x[node]);
    return cut_face(places);
  }
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (x[f[b]] - x[f[a]]).cross(x[f[c]] - x[f[a]]).norm();
  };
  constexpr double flat = 1e-6;  // over the smaller triangle of the other cut
  const double first_smaller = std::min(area(0, 1, 2), area(0, 2, 3)),
               second_smaller = std::min(area(0, 1, 3), area(1, 2, 3));
  bool first = (x[f[2]] - x[f[0]]).squaredNorm() <= (x[f[3]] - x[f[1]]).squaredNorm();
  if ((first ? first_smaller : second_smaller) <= flat * (first ? second_smaller : first_smaller))
    first = !first;
  if (first) return {{0, 1, 2}, {0, 2, 3}};
  return {{0, 1, 3}, {1, 2, 3}};
}

std::vector<std::array<Index, 3>> triangle_neighbours(const Triangulation& surface) {
  using Side = std::array<Index, 4>;  // lower point, higher point, triangle, corner
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangle[k], triangle[(k + 1) % 3]});
      sides.push_back({low, high, static_cast<Index>(t), static_cast<Index>(k)});
    }
  }
  std::ranges::sort(sides);
  std::vector<std::array<Index, 3>> out(surface.triangles.size(), {-1, -1, -1});
  const auto same = [&](std::size_t a, std::size_t b) {
    return sides[a][0] == sides[b][0] && sides[a][1] == sides[b][1];
  };
  for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
    for (end = k + 1; end < sides.size() && same(k, end);) ++end;
    if (end - k != 2) continue;
    const Side &a = sides[k], &b = sides[k + 1];
    out[at(a[2])][at(a[3])] = b[2];
    out[at(b[2])][at(b[3])] = a[2];
  }
  return out;
}

std::vector<Vec3> point_normals(const Triangulation& surface, std::span<const Vec3> tangents) {
  const std::size_t count = surface.points.size();
  std::vector<Vec3> normals(count, Vec3(0, 0, 0));
  std::vector<unsigned char> border(count, 0);
  const auto neighbours = triangle_neighbours(surface);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = at(triangle[(k + 1) % 3]), last = at(triangle[(k + 2) % 3]);
      const Vec3 a = surface.points[next] - surface.points[at(triangle[k])];
      const Vec3 b = surface.points[last] - surface.points[at(triangle[k])];
      const double lengths = a.squaredNorm() * b.squaredNorm();
      if (lengths > 0) normals[at(triangle[k])] += a.cross(b) / lengths;
      if (neighbours[t][k] < 0) border[at(triangle[k])] = border[next] = 1;
    }
  }
  const CompressedRows star = triangles_at(surface);
  for (std::size_t p = 0; p < count; ++p) {
    if (normals[p].norm() == 0) continue;
    normals[p].normalize();
    if (border[p] == 0) continue;
    Vec3 normal = paraboloid_normal(surface, star, static_cast<Index>(p), normals[p]);
    normal -= normal.dot(tangents[p]) * tangents[p];
    if (normal.norm() > 0.5) normals[p] = normal.normalized();
  }
  return normals;
}

namespace {

/// Barycentric coordinates of the point of a flat triangle nearest to a point (C. Ericson,
/// "Real-Time Collision Detection", 5.1.5).
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Vec3 nearest_in(const Triangulation& surface, Index triangle, const Vec3& point) {
  const auto& [a, b, c] = surface.triangles[at(triangle)];
  return nearest_in_triangle(point, surface.points[at(a)], surface.points[at(b)],
                             surface.points[at(c)]);
}

}  // namespace

Vec3 point_at(const Triangulation& surface, const TrianglePlace& place) {
  const auto& [a, b, c] = surface.triangles[at(place.triangle)];
  return place.barycentric[0] * surface.points[at(a)] +
         place.barycentric[1] * surface.points[at(b)] +
         place.barycentric[2] * surface.points[at(c)];
}

TriangleTree::TriangleTree(const Triangulation& surface) {
  std::vector<Box<3>> boxes;
  boxes.reserve(surface.triangles.size());
  for (const auto& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle;
    boxes.push_back(Box<3>::around(
        std::array{surface.points[at(a)], surface.points[at(b)], surface.points[at(c)]}));
  }
  tree_ = BoxTree<3>(boxes);
}

TrianglePlace TriangleTree::nearest(const Triangulation& surface, const Vec3& point) const {
  const auto distance = [&](Index t) {
    return (point_at(surface, {t, nearest_in(surface, t, point)}) - point).norm();
  };
  const auto found = tree_.nearest(point, std::numeric_limits<double>::infinity(), distance);
  return {found->item, nearest_in(surface, found->item, point)};
}

}  // namespace winslow
