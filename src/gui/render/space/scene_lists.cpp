#include "gui/render/space/scene_lists.h"

#include <utility>

namespace winslow::gui {

namespace {

/// Height of a polygon over its longest side as if it were a rectangle, which is the distance of
/// the lines along that side.
double spacing_of(double area, double longest) { return longest > 0 ? area / longest : 0; }

double longest_side(std::span<const Vec3> corners) {
  double longest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    longest = std::max(longest, (corners[(k + 1) % corners.size()] - corners[k]).norm());
  return longest;
}

/// Twice the area of any plane polygon, as a vector.
Vec3 doubled_area(std::span<const Vec3> corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return sum;
}

/// A spacing of 0 would mean that the line never fades.
float spacing_to_fade(double spacing) {
  return std::max(static_cast<float>(spacing), std::numeric_limits<float>::min());
}

/// Splits a polygon into triangles: a fan if it is convex, as sections of tetrahedra are.
void fan_of(std::span<const Vec3> corners, const Vec3& normal, std::vector<Index>& triangles) {
  triangles.clear();
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n && n > 3; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % n], &c = corners[(k + 2) % n];
    if ((b - a).cross(c - b).dot(normal) > 0) continue;
    triangles = cut_polygon(corners, normal);
    return;
  }
  for (std::size_t k = 1; k + 1 < n; ++k)
    for (const std::size_t corner : {std::size_t{0}, k, k + 1})
      triangles.push_back(static_cast<Index>(corner));
}

}  // namespace

std::array<float, 3> SceneLists::relative(const Vec3& p) const {
  const Eigen::Vector3f q = (p - origin_).cast<float>();
  return {q.x(), q.y(), q.z()};
}

void SceneLists::add_triangle(SpaceFill& fill, const std::array<Vec3, 3>& corners,
                              const TriangleLook& look) const {
  const Eigen::Vector3f n = look.normal.cast<float>();
  for (const Vec3& corner : corners)
    fill.corners.push_back({relative(corner), {n.x(), n.y(), n.z()}, look.rgba});
  fill.elements.push_back(look.element);
}

/// A quadrilateral has one normal, hence one shade; it is cut along its shorter diagonal.
void SceneLists::add_faces(SpaceFill& fill, std::span<const SurfaceFace> faces,
                           const Color& color) const {
  std::vector<Vec3> corners;
  std::vector<Index> triangles;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f].nodes;
    const TriangleLook look{area_vector(x_, face).normalized(), color(f), faces[f].element};
    if (face.size() == 3) {
      add_triangle(fill, {x_[face[0]], x_[face[1]], x_[face[2]]}, look);
      continue;
    }
    if (face.size() > 4) {
      corners.clear();
      for (const Index node : face) corners.push_back(x_[node]);
      triangles = cut_polygon(corners, look.normal);
      for (std::size_t t = 0; t < triangles.size(); t += 3)
        add_triangle(fill,
                     {corners[at(triangles[t])], corners[at(triangles[t + 1])],
                      corners[at(triangles[t + 2])]},
                     look);
      continue;
    }
    const std::array<Vec3, 4> p{x_[face[0]], x_[face[1]], x_[face[2]], x_[face[3]]};
    const std::size_t s = (p[2] - p[0]).squaredNorm() <= (p[3] - p[1]).squaredNorm() ? 0 : 1;
    add_triangle(fill, {p[s], p[s + 1], p[s + 2]}, look);
    add_triangle(fill, {p[s], p[s + 2], p[(s + 3) % 4]}, look);
  }
}

void SceneLists::add_section(SpaceFill& fill, const PlaneSection& section, const Plane& plane,
                             const Color& color) const {
  std::vector<Vec3> corners;
  std::vector<Index> triangles;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    corners.clear();
    for (const Index point : section.polygons[k]) corners.push_back(section.points[at(point)]);
    fan_of(corners, plane.normal(), triangles);
    const TriangleLook look{plane.normal(), color(at(k)), section.elements[at(k)]};
    for (std::size_t t = 0; t < triangles.size(); t += 3)
      add_triangle(
          fill,
          {corners[at(triangles[t])], corners[at(triangles[t + 1])], corners[at(triangles[t + 2])]},
          look);
  }
}

void SceneLists::add_line(SpaceLines& lines, const Vec3& a, const Vec3& b, double spacing) const {
  const float s = spacing < 0 ? 0.0f : spacing_to_fade(spacing);
  lines.ends.push_back({relative(a), s});
  lines.ends.push_back({relative(b), s});
}

void SceneLists::add_edges(const EdgeLists& lists, std::span<const SurfaceFace> faces,
                           double feature_angle) const {
  const SurfaceEdges edges = surface_edges(faces);
  const std::vector<unsigned char> sharp = feature_edges(x_, faces, edges, feature_angle);
  std::vector<double> spacing(lists.other ? faces.size() : 0);
  std::vector<Vec3> corners;
  for (std::size_t f = 0; f < spacing.size(); ++f) {
    corners.clear();
    for (const Index node : faces[f].nodes) corners.push_back(x_[node]);
    spacing[f] = spacing_of(area_vector(x_, faces[f].nodes).norm(), longest_side(corners));
  }
  for (std::size_t k = 0; k < sharp.size(); ++k) {
    const auto [a, b] = edges.nodes[k];
    if (sharp[k] != 0) {
      add_line(*lists.feature, x_[a], x_[b], -1);
    } else if (lists.other) {
      double least = std::numeric_limits<double>::max();
      for (const Index f : edges.faces[static_cast<Index>(k)])
        least = std::min(least, spacing[at(f)]);
      add_line(*lists.other, x_[a], x_[b], least);
    }
  }
}

void SceneLists::add_sides(const EdgeLists& lists, const PlaneSection& section) const {
  struct Side {
    Index low, high;
    double spacing;
  };
  std::vector<Side> sides;
  sides.reserve(section.polygons.values.size());
  std::vector<std::size_t> begin(section.points.size() + 2, 0);  // first side of each low end
  std::vector<Vec3> corners;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    corners.clear();
    for (const Index point : section.polygons[k]) corners.push_back(section.points[at(point)]);
    const double spacing = spacing_of(0.5 * doubled_area(corners).norm(), longest_side(corners));
    const auto points = section.polygons[k];
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [low, high] = std::minmax({points[i], points[(i + 1) % points.size()]});
      sides.push_back({low, high, spacing});
      ++begin[at(low) + 2];
    }
  }
  // Few sides share a low end: sorted by it first, hardly anything is left to sort.
  for (std::size_t k = 2; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<Side> sorted(sides.size());
  for (const Side& side : sides) sorted[begin[at(side.low) + 1]++] = side;
  for (std::size_t low = 0; low < section.points.size(); ++low)
    std::ranges::sort(std::span(sorted).subspan(begin[low], begin[low + 1] - begin[low]), {},
                      &Side::high);
  sides = std::move(sorted);
  for (std::size_t k = 0; k < sides.size();) {
    const std::size_t first = k;
    double least = sides[k].spacing;
    for (;
         k < sides.size() && sides[k].low == sides[first].low && sides[k].high == sides[first].high;
         ++k)
      least = std::min(least, sides[k].spacing);
    const Vec3 &a = section.points[at(sides[first].low)],
               &b = section.points[at(sides[first].high)];
    if (k - first == 1)
      add_line(*lists.feature, a, b, -1);
    else if (lists.other)
      add_line(*lists.other, a, b, least);
  }
}

void SceneLists::add_lines(SpaceLines& lines, std::span<const Face> edges) const {
  for (const Face& edge : edges) add_line(lines, x_[edge[0]], x_[edge[1]], -1);
}

void SceneLists::add_cut(SpaceLines& lines, std::span<const SurfaceFace> faces,
                         const Plane& plane) const {
  std::vector<Vec3> crossings;
  for (const SurfaceFace& face : faces) {
    const std::size_t n = face.nodes.size();
    crossings.clear();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 p = x_[face.nodes[k]], q = x_[face.nodes[(k + 1) % n]];
      const double a = plane.distance(p), b = plane.distance(q);
      if ((a >= 0) != (b >= 0)) crossings.emplace_back(p + (q - p) * (a / (a - b)));
    }
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      add_line(lines, crossings[k], crossings[k + 1], -1);
  }
}

}  // namespace winslow::gui
