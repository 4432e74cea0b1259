#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "core/formulation/cell_targets.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/types.h"

namespace winslow {

/// Metric of a target triangle over its two edges m1, m2 from the corner: symmetric, determinant 1.
/// It is the inverse of their Gram matrix, scaled. Two triangles are similar if their metrics are
/// the same; the distance between metrics is twice the logarithm of s1 / s2, see stretch_between().
struct TargetMetric {
  double a11 = 0, a12 = 0, a22 = 0;

  /// For edges in space (D = 3): in their own plane.
  template <int D>
  static TargetMetric of(const Vec<D>& m1, const Vec<D>& m2) {
    double det = 0;
    if constexpr (D == 2)
      det = m1.x() * m2.y() - m1.y() * m2.x();
    else
      det = m1.cross(m2).norm();
    return {m2.squaredNorm() / det, -m1.dot(m2) / det, m1.squaredNorm() / det};
  }
  static TargetMetric of_angle(double angle) {
    return of<2>(Vec2(1, 0), Vec2(std::cos(angle), std::sin(angle)));
  }
  static TargetMetric of(const ShapeTerm& term) {
    return {term.ab + term.bc, -term.bc, term.ac + term.bc};
  }
  TargetMetric& add(double share, const TargetMetric& other) {
    a11 += share * other.a11;
    a12 += share * other.a12;
    a22 += share * other.a22;
    return *this;
  }
  /// A sum of such metrics, scaled back to determinant 1, lies on the geodesic between them.
  TargetMetric normalized() const {
    const double scale = 1 / std::sqrt(a11 * a22 - a12 * a12);
    return {a11 * scale, a12 * scale, a22 * scale};
  }
  ShapeTerm term(double weight) const { return {a11 + a12, a22 + a12, -a12, weight}; }
};

/// Logarithm of s1 / s2, the singular values of the linear map between triangles with these
/// metrics: 0 if they are similar.
inline double stretch_between(const TargetMetric& a, const TargetMetric& b) {
  return std::acosh(std::max(1.0, 0.5 * (a.a22 * b.a11 + a.a11 * b.a22) - a.a12 * b.a12));
}

/// The metric at `share` of the way along the geodesic from a (0) to b (1).
inline TargetMetric between(const TargetMetric& a, const TargetMetric& b, double share) {
  const double way = stretch_between(a, b);
  TargetMetric metric;
  constexpr double short_way = 1e-4;  // below it sinh(t) = t to round-off
  if (way < short_way) return metric.add(1 - share, a).add(share, b).normalized();
  metric.add(std::sinh((1 - share) * way) / std::sinh(way), a);
  metric.add(std::sinh(share * way) / std::sinh(way), b);
  return metric;
}

/// Three edges from a node of a tetrahedron, as columns.
using Edges3 = Eigen::Matrix3d;

/// Metric of a target tetrahedron over its three edges: the inverse of their Gram matrix, scaled to
/// determinant 1. Two tetrahedra are similar if their metrics are the same.
inline Eigen::Matrix3d volume_metric(const Edges3& edges) {
  // Uses the cofactors of the edges: the determinant of the metric itself suffers from cancellation
  // if the tetrahedron is flat.
  Eigen::Matrix3d cofactors;
  for (int k = 0; k < 3; ++k)
    cofactors.row(k) = edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3));
  const double root = std::cbrt(edges.determinant());
  return cofactors * cofactors.transpose() / (root * root * root * root);
}

/// Whether a corner is right-handed and not so flat that its metric is only round-off. The limit is
/// a tetrahedron 10 million times as long as high.
inline bool has_metric(const Edges3& edges) {
  constexpr double flattest = 1e-7;
  const double lengths = edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
  return edges.determinant() > flattest * lengths;
}

/// A sum of metrics, scaled back to determinant 1.
inline Eigen::Matrix3d normalized_metric(const Eigen::Matrix3d& sum) {
  const Eigen::Matrix3d lower = sum.llt().matrixL();
  const double root = std::cbrt(lower.diagonal().prod());
  return sum / (root * root);
}

inline VolumeTerm volume_term(const Eigen::Matrix3d& a, double weight) {
  return {a(0, 0), a(0, 1), a(0, 2), a(1, 1), a(1, 2), a(2, 2), weight};
}

inline Eigen::Matrix3d metric_of(const VolumeTerm& t) {
  Eigen::Matrix3d a;
  a << t.a11, t.a12, t.a13, t.a12, t.a22, t.a23, t.a13, t.a23, t.a33;
  return a;
}

/// The metric of a corner of a plane element if it were regular, a polygon with its flat corners
/// evenly along its sides. triangle: index into ElementShape::corner_triangles. None of a triangle
/// at a flat corner.
std::optional<TargetMetric> regular_metric_of_face(const ElementShape& shape, std::size_t triangle);

/// Metrics of the corners of the regular element, in the order of corner_tetrahedra().
const std::vector<Eigen::Matrix3d>& regular_metrics(ElementType type);
/// The metric of a corner of a volume element if it were regular; none of a corner of a polyhedron
/// for which there is no regular one.
std::optional<Eigen::Matrix3d> regular_metric(const ElementShape& shape, std::size_t corner);
/// Cholesky factors of these.
const std::vector<Eigen::Matrix3d>& regular_factors(ElementType type);
/// The metrics of edge_tetrahedra().
const std::vector<Eigen::Matrix3d>& regular_edge_metrics(ElementType type);

/// L^-1 b, L lower triangular.
inline Eigen::Matrix3d solve_lower(const Eigen::Matrix3d& lower, const Eigen::Matrix3d& b) {
  const Vec3 inverse(1 / lower(0, 0), 1 / lower(1, 1), 1 / lower(2, 2));
  Eigen::Matrix3d x;
  for (int k = 0; k < 3; ++k) {
    x(0, k) = b(0, k) * inverse[0];
    const double second = b(1, k) - lower(1, 0) * x(0, k), third = b(2, k) - lower(2, 0) * x(0, k);
    x(1, k) = second * inverse[1];
    x(2, k) = (third - lower(2, 1) * x(1, k)) * inverse[2];
  }
  return x;
}

/// L^-1 b L^-T, symmetric. Its eigenvalues are the squares of the singular values of the map
/// between the shapes of the metrics b and L L^T.
inline Eigen::Matrix3d relative_metric(const Eigen::Matrix3d& lower, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d seen = solve_lower(lower, solve_lower(lower, b).transpose());
  return 0.5 * (seen + seen.transpose());
}

/// Logarithm of the largest over the smallest singular value, of the eigenvalues above: 0 if the
/// shapes are similar.
inline double stretch_of(const Vec3& squares) { return 0.5 * std::log(squares[2] / squares[0]); }

/// Simultaneous decomposition of two metrics: a = L L^T, and L^-1 b L^-T = V diag(values) V^T.
struct RelativeMetric {
  Eigen::Matrix3d lower, vectors;
  Vec3 values;  ///< ascending; squares of the singular values of the map between the shapes

  RelativeMetric(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) : lower(a.llt().matrixL()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(relative_metric(lower, b));
    vectors = eigen.eigenvectors();
    values = eigen.eigenvalues();
  }
  double stretch() const { return stretch_of(values); }
  /// At `share` of the way along the geodesic from a (0) to b (1).
  Eigen::Matrix3d between(double share) const {
    const Eigen::Matrix3d root = lower * vectors;
    const Vec3 power = (share * values.array().log()).exp();
    const double scale = std::cbrt(lower.diagonal().prod());
    return root * power.asDiagonal() * root.transpose() / (scale * scale * std::cbrt(power.prod()));
  }
};

/// Logarithm of the aspect ratio of the linear map between the two shapes: RelativeMetric::stretch
/// to the bit, without the vectors.
inline double stretch_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d relative = relative_metric(a.llt().matrixL(), b);
  return stretch_of(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(relative, Eigen::EigenvaluesOnly)
                        .eigenvalues());
}

/// The same to within `stretch_error` for a stretch up to 3, by the formula for the roots of a
/// cubic: ten times as fast, for comparisons with limits. A larger stretch comes out as more than
/// 2.9, or as infinite. lower: the Cholesky factor of one metric.
inline constexpr double stretch_error = 1e-5;
double quick_stretch(const Eigen::Matrix3d& lower, const Eigen::Matrix3d& metric);

/// The metric of the right-angled corner `regular` with the edge lengths of the corner `own`: a
/// rectangle, a box, or an upright prism over an equilateral triangle. Another corner is returned
/// as it is.
TargetMetric with_lengths_of(const TargetMetric& own, const TargetMetric& regular);
Eigen::Matrix3d with_lengths_of(const Eigen::Matrix3d& own, const Eigen::Matrix3d& regular);

/// Gives targets of single corners the edge lengths that the corner has in a mesh, so that only its
/// angles count. The edges depend on the element:
///
/// - quadrilateral: both edges of a corner; hexahedron: all three;
/// - prism: the edge along its height; the two edges of the triangle take their mean length;
/// - edge_tetrahedra() of these: the edges that would meet there at right angles; one of them
///   starts at the other end of the edge.
///
/// Targets of triangles and tetrahedra stay unchanged, since they represent the whole element. x:
/// the nodes, in space also for D = 2 (surface meshes).
template <int D, int S>
CellTargets<D> with_corner_lengths(CellTargets<D> targets, const Points<S>& x);

}  // namespace winslow
