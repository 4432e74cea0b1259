#include "core/quality/validity.h"

#include <utility>

#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// True if the sizes of the coefficients alone show that d0 + d1 t + d2 t^2 + d3 t^3 is positive up
/// to t = most. This decides almost all elements without computing a root.
bool stays_positive(double d0, double d1, double d2, double d3, double most) {
  constexpr double round_off = 1e-12;
  const double fall = most * (std::abs(d1) + most * (std::abs(d2) + most * std::abs(d3)));
  return d0 * (1 - round_off) > fall;
}

/// The step of a corner with the area d0 + d1 t + d2 t^2.
double area_step(double d0, double d1, double d2, double most) {
  if (!(d0 > 0)) return 0;
  return stays_positive(d0, d1, d2, 0, most) ? most : first_positive_root(d0, d1, d2);
}

/// The step of a corner, given by its node and the ends of its two edges.
double corner_step(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to, double most) {
  const Vec2 u = from[1] - from[0], v = from[2] - from[0];
  const Vec2 du = to[1] - to[0] - u, dv = to[2] - to[0] - v;
  const double d1 = u.x() * dv.y() - u.y() * dv.x() + du.x() * v.y() - du.y() * v.x();
  return area_step(cross(u, v), d1, cross(du, dv), most);
}

/// The same in space; the area is measured along the area vector in `from`. normal: the reference
/// normal.
double corner_step(const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to,
                   const Vec3& normal, double most) {
  const Vec3 u = from[1] - from[0], v = from[2] - from[0];
  const Vec3 du = to[1] - to[0] - u, dv = to[2] - to[0] - v;
  const Vec3 area = u.cross(v);
  if (is_turned_over(area, normal)) return 0;
  return area_step(area.squaredNorm(), area.dot(u.cross(dv) + du.cross(v)), area.dot(du.cross(dv)),
                   most);
}

}  // namespace

double first_positive_root(double d0, double d1, double d2) {
  const double discriminant = d1 * d1 - 4 * d0 * d2;
  if (!(discriminant >= 0)) return infinite;
  // The form without cancellation: the roots are q / d2 and d0 / q.
  const double q = -0.5 * (d1 + std::copysign(std::sqrt(discriminant), d1));
  double first = infinite;
  for (const double root : {d2 != 0 ? q / d2 : infinite, q != 0 ? d0 / q : infinite}) {
    if (root > 0) first = std::min(first, root);
  }
  return first;
}

namespace {

/// The root of a polynomial that is positive at `low`, not positive at `high` and monotone between,
/// rounded down.
template <typename Polynomial>
double root_between(const Polynomial& p, double low, double high) {
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = low + 0.5 * (high - low);
    if (!(middle > low && middle < high)) break;
    (p(middle) > 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

double first_positive_root(double d0, double d1, double d2, double d3) {
  const auto p = [&](double t) { return d0 + t * (d1 + t * (d2 + t * d3)); };
  if (!(d0 > 0)) return 0;
  // The cubic is monotone between its extremes.
  std::array<double, 2> extremes{infinite, infinite};
  const double discriminant = d2 * d2 - 3 * d1 * d3;
  if (discriminant >= 0) {
    const double q = -(d2 + std::copysign(std::sqrt(discriminant), d2));
    std::size_t count = 0;
    for (const double t : {d3 != 0 ? q / (3 * d3) : infinite, q != 0 ? d1 / q : infinite}) {
      if (t > 0) extremes[count++] = t;
    }
    if (extremes[0] > extremes[1]) std::swap(extremes[0], extremes[1]);
  }
  double low = 0;
  for (const double t : extremes) {
    if (!std::isfinite(t)) break;
    if (!(p(t) > 0)) return root_between(p, low, t);
    low = t;
  }
  // Beyond the last extreme the cubic is monotone to infinity.
  const bool falls = d3 != 0 ? d3 < 0 : d2 != 0 ? d2 < 0 : d1 < 0;
  if (!falls) return infinite;
  double high = std::max(2 * low, 1.0);
  while (p(high) > 0 && std::isfinite(high)) high *= 2;
  return std::isfinite(high) ? root_between(p, low, high) : infinite;
}

namespace {

double tetrahedron_step(const std::array<Index, 4>& nodes, const SpacePoints& from,
                        const SpacePoints& to, double most) {
  std::array<Vec3, 3> e, de;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = from[nodes[k + 1]] - from[nodes[0]];
    de[k] = to[nodes[k + 1]] - to[nodes[0]] - e[k];
  }
  const auto det = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); };
  const double d0 = det(e[0], e[1], e[2]);
  const double d1 = det(de[0], e[1], e[2]) + det(e[0], de[1], e[2]) + det(e[0], e[1], de[2]);
  const double d2 = det(e[0], de[1], de[2]) + det(de[0], e[1], de[2]) + det(de[0], de[1], e[2]);
  const double d3 = det(de[0], de[1], de[2]);
  return stays_positive(d0, d1, d2, d3, most) ? most : first_positive_root(d0, d1, d2, d3);
}

/// Calls visit(node, next, previous) for each corner that is not flat; once for a triangle, since
/// its corners have the same area.
template <typename Visit>
void for_each_corner(const Topology& topology, Index e, const Visit& visit) {
  const auto nodes = topology.element(e);
  if (topology.element_type(e) == ElementType::polygon) {
    for (const auto& [a, b, c] : topology.shape(e).corner_triangles)
      visit(nodes[at(a)], nodes[at(b)], nodes[at(c)]);
    return;
  }
  const std::size_t count = nodes.size(), corners = count == 3 ? 1 : count;
  for (std::size_t k = 0; k < corners; ++k)
    visit(nodes[k], nodes[(k + 1) % count], nodes[(k + count - 1) % count]);
}

/// Smallest of `most` and step(element, smallest so far) over all elements.
template <typename Step>
double smallest_step(Index elements, double most, int threads, Step&& step) {
  const auto blocks = static_cast<std::size_t>((elements + parallel_block - 1) / parallel_block);
  std::vector<double> steps(blocks, most);
  parallel_for(threads, elements, [&](Index begin, Index end) {
    double smallest = most;
    for (Index e = begin; e < end; ++e) smallest = std::min(smallest, step(e, smallest));
    steps[static_cast<std::size_t>(begin / parallel_block)] = smallest;
  });
  double smallest = most;
  for (const double found : steps) smallest = std::min(smallest, found);
  return smallest;
}

}  // namespace

double largest_valid_step(const Topology& topology, const Coordinates& from, const Coordinates& to,
                          double most, int threads) {
  if (topology.kind() == MeshKind::volume) {
    const SpacePoints before(from), after(to);
    return smallest_step(topology.element_count(), most, threads, [&](Index e, double smallest) {
      const ElementShape& shape = topology.shape(e);
      for (const auto* list : {&shape.corner_tetrahedra, &shape.face_tetrahedra}) {
        for (const auto& nodes : *list) {
          const auto tetrahedron = by_nodes(nodes, topology.element(e));
          smallest = std::min(smallest, tetrahedron_step(tetrahedron, before, after, smallest));
        }
      }
      return smallest;
    });
  }
  require_plane(topology, "steps that keep a mesh valid");
  const PlanePoints before(from), after(to);
  return smallest_step(topology.element_count(), most, threads, [&](Index e, double smallest) {
    for_each_corner(topology, e, [&](Index a, Index b, Index c) {
      smallest = std::min(smallest, corner_step({before[a], before[b], before[c]},
                                                {after[a], after[b], after[c]}, smallest));
    });
    return smallest;
  });
}

double largest_valid_step_on_surface(const Topology& topology, const Coordinates& from,
                                     const Coordinates& to, std::span<const Vec3> normals,
                                     double most, int threads) {
  const SpacePoints before(from), after(to);
  return smallest_step(topology.element_count(), most, threads, [&](Index e, double smallest) {
    for_each_corner(topology, e, [&](Index a, Index b, Index c) {
      smallest =
          std::min(smallest, corner_step({before[a], before[b], before[c]},
                                         {after[a], after[b], after[c]}, normals[at(e)], smallest));
    });
    return smallest;
  });
}

}  // namespace winslow
