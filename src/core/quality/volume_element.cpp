#include "core/quality/volume_element.h"

#include <Eigen/LU>

#include "core/mesh/index_sets.h"
#include "core/mesh/polyhedron.h"
#include "core/mesh/surface_faces.h"
#include "core/quality/finite_volumes.h"

namespace winslow {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Circumradius over three times the inradius, 1 for the regular tetrahedron.
double radius_ratio_of(const VolumeCorner& corner) {
  const Vec3 a = corner.edges.col(0), b = corner.edges.col(1), c = corner.edges.col(2);
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double area2 = bc.norm() + ca.norm() + ab.norm() + (bc + ca + ab).norm();
  const double numerator =
      (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab).norm();
  return numerator * area2 / (6 * corner.determinant * corner.determinant);
}

double scaled_determinant(const VolumeCorner& corner) {
  const double lengths =
      corner.edges.col(0).norm() * corner.edges.col(1).norm() * corner.edges.col(2).norm();
  return lengths > 0 ? corner.determinant / lengths : 0;
}

/// Values of a corner of the regular element.
struct RegularCorner {
  Eigen::Matrix3d inverse;  // of its edges
  double scaled_determinant;
  double radius_ratio;
};

std::vector<RegularCorner> make_regular(ElementType type) {
  const auto places = regular_corners(type);
  std::vector<RegularCorner> list;
  for (const auto& corner : corner_tetrahedra(type)) {
    const auto place = [&](std::size_t k) { return Vec3(places[at(corner[k])].data()); };
    const VolumeCorner regular(place(0), place(1), place(2), place(3));
    list.push_back(
        {regular.edges.inverse(), scaled_determinant(regular), radius_ratio_of(regular)});
  }
  return list;
}

const std::vector<RegularCorner>& regular(ElementType type) {
  static const auto lists = table_by_type(make_regular);
  return lists[static_cast<std::size_t>(type)];
}

/// The corner of a polyhedron if it were regular; that of a cube where this is not known.
RegularCorner make_regular_of(const std::array<std::uint8_t, 3>& face_sizes) {
  const auto edges = face_sizes[0] > 0
                         ? regular_corner(face_sizes)
                         : std::array<Vec3, 3>{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const VolumeCorner corner(Vec3::Zero(), edges[0], edges[1], edges[2]);
  return {corner.edges.inverse(), scaled_determinant(corner), radius_ratio_of(corner)};
}

/// The same from a table for faces of usual sizes: cells of dual meshes have dozens of corners.
RegularCorner regular_of(const std::array<std::uint8_t, 3>& face_sizes) {
  constexpr std::size_t sizes = 12;  // 0 to 11
  static const auto table = [] {
    std::vector<RegularCorner> list;
    for (std::size_t k = 0; k < sizes * sizes * sizes; ++k) {
      const std::array of{k / (sizes * sizes), k / sizes % sizes, k % sizes};
      const bool possible =
          of[0] == 0 || std::ranges::all_of(of, [](std::size_t n) { return n >= 3; });
      list.push_back(possible ? make_regular_of({static_cast<std::uint8_t>(of[0]),
                                                 static_cast<std::uint8_t>(of[1]),
                                                 static_cast<std::uint8_t>(of[2])})
                              : RegularCorner{});
    }
    return list;
  }();
  const std::size_t a = face_sizes[0], b = face_sizes[1], c = face_sizes[2];
  return std::max({a, b, c}) < sizes ? table[(a * sizes + b) * sizes + c]
                                     : make_regular_of(face_sizes);
}

/// Calls visit(corner, corner of the regular element) for the corners of an element, until one of
/// the calls returns false.
template <typename Visit>
void visit_corners(const SpacePoints& x, const ElementShape& shape, std::span<const Index> corners,
                   const Visit& visit) {
  const auto tetrahedra = shape.corner_tetrahedra;
  const bool fixed = shape.type != ElementType::polyhedron;
  for (std::size_t k = 0; k < tetrahedra.size(); ++k) {
    const VolumeCorner corner(x, by_nodes(tetrahedra[k], corners));
    if (!(fixed ? visit(corner, regular(shape.type)[k])
                : visit(corner, regular_of(shape.face_sizes[k]))))
      return;
  }
}

/// Largest value of measure(corner, corner of the regular element); infinite if a corner is
/// inverted.
template <typename Measure>
double largest_of_corners(const SpacePoints& x, const ElementShape& shape,
                          std::span<const Index> corners, Measure&& measure) {
  double largest = 0;
  visit_corners(x, shape, corners, [&](const VolumeCorner& corner, const RegularCorner& best) {
    largest = corner.inverted() ? unbounded : std::max(largest, measure(corner, best));
    return largest < unbounded;
  });
  return largest;
}

}  // namespace

bool VolumeElement::inverted() const { return !has_positive_jacobian(x_, shape_, corners_); }

double VolumeElement::scaled_jacobian() const {
  double smallest = unbounded;
  visit_corners(x_, shape_, corners_, [&](const VolumeCorner& corner, const RegularCorner& best) {
    double scaled = scaled_determinant(corner);
    if (shape_.like == ElementType::tetrahedron) {
      // All four corners have the same determinant: the one with the longest edges is the smallest.
      const auto length = [&](int i, int j) {
        return (corner.edges.col(i) - corner.edges.col(j)).norm();
      };
      const double l1 = corner.edges.col(0).norm(), l2 = corner.edges.col(1).norm(),
                   l3 = corner.edges.col(2).norm();
      const double l12 = length(0, 1), l13 = length(0, 2), l23 = length(1, 2);
      const double longest =
          std::max({l1 * l2 * l3, l1 * l12 * l13, l2 * l12 * l23, l3 * l13 * l23});
      scaled = longest > 0 ? corner.determinant / longest : 0;
    }
    smallest = std::min(smallest, scaled / best.scaled_determinant);
    return true;
  });
  // A polyhedron of flat corners has no other measure of its shape.
  return smallest < unbounded ? smallest : inverted() ? 0 : 1;
}

double VolumeElement::radius_ratio() const {
  return largest_of_corners(x_, shape_, corners_,
                            [](const VolumeCorner& corner, const RegularCorner& best) {
                              return radius_ratio_of(corner) / best.radius_ratio;
                            });
}

double VolumeElement::condition_number() const {
  return largest_of_corners(x_, shape_, corners_,
                            [](const VolumeCorner& corner, const RegularCorner& best) {
                              const Eigen::Matrix3d j = corner.edges * best.inverse;
                              return j.norm() * j.inverse().norm() / 3;
                            });
}

double VolumeElement::solid_angle(std::size_t corner) const {
  if (shape_.type == ElementType::polyhedron) return solid_angle_of_faces(corner);
  const Face& link = shape_.links[corner];
  const Vec3 p = x_[corners_[corner]];
  const auto edge = [&](std::size_t k) { return Vec3(x_[corners_[at(link[k])]] - p); };
  double sum = 0;
  for (std::size_t k = 1; k + 1 < link.size(); ++k)
    sum += solid_angle_of(edge(0), edge(k), edge(k + 1));
  return sum;
}

/// The sum of the angles between the faces at the corner, less (n - 2) pi (Girard). Also holds for
/// a corner inside an edge or inside a face, at which edges lie in one line or plane.
double VolumeElement::solid_angle_of_faces(std::size_t corner) const {
  const Face& link = shape_.links[corner];
  const std::size_t n = link.size();
  std::vector<Vec3> areas(n);  // of the face between the edges k and k + 1
  for (const Face& face : shape_.faces) {
    const std::size_t m = face.size(), k = index_of(face, static_cast<Index>(corner));
    if (k == m) continue;
    const std::size_t place = index_of(link, face[(k + m - 1) % m]);
    areas[place] = area_vector(x_, by_nodes(face, corners_));
  }
  double sum = (2 - static_cast<double>(n)) * pi;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &one = areas[(k + n - 1) % n], &other = areas[k];
    const Vec3 along = (x_[corners_[at(link[k])]] - x_[corners_[corner]]).normalized();
    sum += pi - std::atan2(along.dot(one.cross(other)), one.dot(other));
  }
  return sum;
}

const VolumeElement::SolidAngles& VolumeElement::solid_angles() const {
  if (solid_angles_) return *solid_angles_;
  SolidAngles& angles = solid_angles_.emplace(SolidAngles{unbounded, -unbounded});
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const double angle = solid_angle(k);
    angles.smallest = std::min(angles.smallest, angle);
    angles.largest = std::max(angles.largest, angle);
  }
  return angles;
}

double VolumeElement::volume() const {
  return signed_volume6(coordinates_, shape_, corners_, x_[corners_[0]]) / 6;
}

namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// Whether the tetrahedra at the corners are positive, and those over the faces of polyhedra.
bool corners_positive(const SpacePoints& x, const ElementShape& shape,
                      std::span<const Index> corners) {
  for (const auto* list : {&shape.corner_tetrahedra, &shape.face_tetrahedra})
    for (const auto& nodes : *list)
      if (VolumeCorner(x, by_nodes(nodes, corners)).inverted()) return false;
  return true;
}

/// Smallest value over [0, 1] of the quadratic with these values at 0, 1/2 and 1.
double smallest_of_quadratic(double start, double middle, double end) {
  const double curve = 2 * (start - 2 * middle + end), slope = -3 * start + 4 * middle - end;
  const double least = std::min(start, end);
  if (!(curve > 0)) return least;
  const double t = -slope / (2 * curve);
  return t > 0 && t < 1 ? std::min(least, start + t * (slope + t * curve)) : least;
}

bool prism_positive(const SpacePoints& x, std::span<const Index> corners) {
  std::array<Vec3, 3> low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = x[corners[k]];
    high[k] = x[corners[k + 3]];
  }
  // Jacobian at corner k of the triangle at height t.
  const auto at_corner = [&](std::size_t k, double t) {
    const auto place = [&](std::size_t i) { return Vec3((1 - t) * low[i] + t * high[i]); };
    const Vec3 p = place(0);
    return determinant(place(1) - p, place(2) - p, high[k] - low[k]);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(smallest_of_quadratic(at_corner(k, 0), at_corner(k, 0.5), at_corner(k, 1)) > 0))
      return false;
  }
  return true;
}

/// Values of a polynomial of degree two in each of three directions at the 27 points of the lattice
/// {0, 1/2, 1}^3, or its Bernstein coefficients; the first direction runs fastest.
using Lattice = std::array<double, 27>;

/// Calls change(first, second, third) with the values along every line of each direction.
template <typename Change>
void along_lines(Lattice& values, Change&& change) {
  for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{9}}) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i / step % 3 == 0) change(values[i], values[i + step], values[i + 2 * step]);
    }
  }
}

Lattice bernstein(Lattice values) {
  along_lines(values, [](double start, double& middle, double end) {
    middle = 2 * middle - 0.5 * (start + end);
  });
  return values;
}

/// Bernstein coefficients over one of the eight parts, halves along each direction.
Lattice part_of(Lattice c, std::size_t which) {
  std::size_t direction = 0;
  for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{9}}) {
    const bool upper = (which >> direction++ & 1U) != 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (i / step % 3 != 0) continue;
      double &a = c[i], &b = c[i + step], &d = c[i + 2 * step];
      const double ab = 0.5 * (a + b), bd = 0.5 * (b + d), middle = 0.5 * (ab + bd);
      if (upper) {
        a = middle;
        b = bd;
      } else {
        b = ab;
        d = middle;
      }
    }
  }
  return c;
}

bool all_positive(const Lattice& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
}

/// The Bernstein coefficients at the corners are values of the polynomial.
bool corner_values_positive(const Lattice& c) {
  for (const unsigned i : {0U, 2U, 6U, 8U, 18U, 20U, 24U, 26U}) {
    if (!(c[i] > 0)) return false;
  }
  return true;
}

bool positive_over(const Lattice& coefficients, int depth) {
  if (all_positive(coefficients)) return true;
  if (depth == 0 || !corner_values_positive(coefficients)) return false;
  for (std::size_t part = 0; part < 8; ++part) {
    if (!positive_over(part_of(coefficients, part), depth - 1)) return false;
  }
  return true;
}

/// The Jacobian of the trilinear map at the points of the lattice.
Lattice jacobians(const SpacePoints& x, std::span<const Index> corners) {
  // Corners in the order of their coordinates; the first direction runs fastest.
  constexpr std::array<std::size_t, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < 8; ++k) p[k] = x[corners[order[k]]];
  // Derivative along direction d, bilinear in the other two coordinates.
  const auto derivative = [&](std::size_t d, double s, double t) {
    const std::size_t step = std::size_t{1} << d, one = std::size_t{1} << ((d + 1) % 3),
                      two = std::size_t{1} << ((d + 2) % 3);
    const auto edge = [&](std::size_t from) { return Vec3(p[from + step] - p[from]); };
    return Vec3((1 - s) * (1 - t) * edge(0) + s * (1 - t) * edge(one) + (1 - s) * t * edge(two) +
                s * t * edge(one + two));
  };
  Lattice values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double u = 0.5 * static_cast<double>(i % 3), v = 0.5 * static_cast<double>(i / 3 % 3),
                 w = 0.5 * static_cast<double>(i / 9 % 3);
    values[i] = determinant(derivative(0, v, w), derivative(1, w, u), derivative(2, u, v));
  }
  return values;
}

bool hexahedron_positive(const SpacePoints& x, std::span<const Index> corners) {
  constexpr int divisions = 5;
  const Lattice values = jacobians(x, corners);
  if (!all_positive(values)) return false;
  return positive_over(bernstein(values), divisions);
}

/// Mean of the edges along one direction of a hexahedron or prism, and their largest distance from
/// it.
struct EdgeBundle {
  Vec3 mean = Vec3::Zero();
  double spread = 0;

  template <std::size_t n>
  EdgeBundle(const SpacePoints& x, std::span<const Index> corners,
             const std::array<std::array<std::size_t, 2>, n>& edges) {
    std::array<Vec3, n> all;
    for (std::size_t k = 0; k < n; ++k) all[k] = x[corners[edges[k][1]]] - x[corners[edges[k][0]]];
    for (const Vec3& edge : all) mean += edge / static_cast<double>(n);
    for (const Vec3& edge : all) spread = std::max(spread, (edge - mean).squaredNorm());
    spread = std::sqrt(spread);
  }
};

/// Whether the Jacobian is positive for any three vectors within the spreads of the bundles. The
/// derivatives of the map lie within them, as convex sums of the edges, so that almost all elements
/// need no other test.
bool surely_positive(const EdgeBundle& a, const EdgeBundle& b, const EdgeBundle& c) {
  constexpr double round_off = 1e-9;
  const double la = a.mean.norm(), lb = b.mean.norm(), lc = c.mean.norm();
  const double change = (la + a.spread) * (lb + b.spread) * (lc + c.spread) - la * lb * lc;
  return determinant(a.mean, b.mean, c.mean) > change + round_off * la * lb * lc;
}

using Edges4 = std::array<std::array<std::size_t, 2>, 4>;

bool hexahedron_surely_positive(const SpacePoints& x, std::span<const Index> corners) {
  return surely_positive(EdgeBundle(x, corners, Edges4{{{0, 1}, {3, 2}, {4, 5}, {7, 6}}}),
                         EdgeBundle(x, corners, Edges4{{{0, 3}, {1, 2}, {4, 7}, {5, 6}}}),
                         EdgeBundle(x, corners, Edges4{{{0, 4}, {1, 5}, {2, 6}, {3, 7}}}));
}

bool prism_surely_positive(const SpacePoints& x, std::span<const Index> corners) {
  using Edges2 = std::array<std::array<std::size_t, 2>, 2>;
  using Edges3 = std::array<std::array<std::size_t, 2>, 3>;
  return surely_positive(EdgeBundle(x, corners, Edges2{{{0, 1}, {3, 4}}}),
                         EdgeBundle(x, corners, Edges2{{{0, 2}, {3, 5}}}),
                         EdgeBundle(x, corners, Edges3{{{0, 3}, {1, 4}, {2, 5}}}));
}

/// Whether the centroid of a polyhedron lies behind all its faces.
bool pyramids_positive(const SpacePoints& x, const ElementShape& shape,
                       std::span<const Index> corners) {
  std::vector<FaceGeometry> faces;
  faces.reserve(shape.faces.size());
  std::vector<Vec3> places;
  places.reserve(8);
  for (const Face& face : shape.faces) {
    places.clear();
    for (const Index k : face) places.emplace_back(x[corners[at(k)]]);
    faces.push_back(face_geometry(places));
  }
  const CellGeometry cell = cell_geometry(faces);
  return cell.volume > 0 && std::ranges::all_of(faces, [&](const FaceGeometry& face) {
           return face.area.dot(face.centre - cell.centre) > 0;
         });
}

}  // namespace

bool has_positive_jacobian(const SpacePoints& x, const ElementShape& shape,
                           std::span<const Index> corners) {
  if (shape.type == ElementType::hexahedron && hexahedron_surely_positive(x, corners)) return true;
  if (shape.type == ElementType::prism && prism_surely_positive(x, corners)) return true;
  if (!corners_positive(x, shape, corners)) return false;
  if (shape.type == ElementType::prism) return prism_positive(x, corners);
  if (shape.type == ElementType::hexahedron) return hexahedron_positive(x, corners);
  if (shape.type == ElementType::polyhedron) return pyramids_positive(x, shape, corners);
  return true;
}

}  // namespace winslow
