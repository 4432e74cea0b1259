#include "core/formulation/distortion.h"

#include <algorithm>

namespace winslow::distortion {

namespace {

struct Matrix2 {
  double a, b, c, d;  // [[a, b], [c, d]]
};

Matrix2 product(const Matrix2& l, const Matrix2& r) {
  return {l.a * r.a + l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c,
          l.c * r.b + l.d * r.d};
}
Matrix2 times_transposed(const Matrix2& l, const Matrix2& r) {
  return product(l, {r.a, r.c, r.b, r.d});
}

/// J = U diag(s1, s2) V^T with rotations U, V; s2 > 0 if det J > 0.
struct SingularValues {
  double s1, s2;
  Matrix2 u, v;

  explicit SingularValues(const Matrix2& j) {
    const double e = 0.5 * (j.a + j.d), f = 0.5 * (j.a - j.d);
    const double g = 0.5 * (j.c + j.b), h = 0.5 * (j.c - j.b);
    const double q = std::hypot(e, h), r = std::hypot(f, g);
    s1 = q + r;
    // q - r cancels for thin triangles.
    s2 = (j.a * j.d - j.b * j.c) / s1;
    const double a1 = std::atan2(g, f), a2 = std::atan2(h, e);
    const double phi = 0.5 * (a2 + a1), theta = 0.5 * (a2 - a1);
    u = {std::cos(phi), -std::sin(phi), std::sin(phi), std::cos(phi)};
    v = {std::cos(theta), std::sin(theta), -std::sin(theta), std::cos(theta)};
  }
  /// U M V^T.
  Matrix2 between(const Matrix2& m) const { return times_transposed(product(u, m), v); }
};

/// The positive eigenpair of the Hessian of psi over the singular values.
struct Scaling {
  double eigenvalue, x, y;

  Scaling(double h11, double h12, double h22) {
    const double mean = 0.5 * (h11 + h22), half = 0.5 * (h11 - h22);
    eigenvalue = mean + std::hypot(half, h12);
    const double angle = 0.5 * std::atan2(h12, half);
    x = std::cos(angle);
    y = std::sin(angle);
  }
};

/// Rank-one part lambda q q^T. m: eigenvector over J.
void add_rank_one(double lambda, const Matrix2& m, const Matrix2& root, TriangleTerm& out) {
  if (!(lambda > 0)) return;
  // <m, dJ> = <m, [du dv] root> = <m root^T, [du dv]>: one vector for each edge.
  const Matrix2 q = times_transposed(m, root);
  const Vector b{q.a, q.c}, c{q.b, q.d}, a{-q.a - q.b, -q.c - q.d};
  const auto outer = [lambda](const Vector& v, const Vector& w) {
    return Block{lambda * v.x * w.x, lambda * v.x * w.y, lambda * v.y * w.x, lambda * v.y * w.y};
  };
  out.ab += outer(a, b);
  out.ac += outer(a, c);
  out.bc += outer(b, c);
}

}  // namespace

TriangleTerm projected_triangle_term(const Corner2& q, const Form& c, double weight,
                                     const PenaltyFunction& psi) {
  TriangleTerm out = triangle_term(q, c, weight, psi, {q.d, 1}, 0);
  out.ab = out.ac = out.bc = {};
  // The metric over the edges (u, v) is A = root root^T: J = [u v] root.
  const double a11 = c.ij + c.jk, a12 = -c.jk, a22 = c.ik + c.jk;
  const double r11 = std::sqrt(a11), r21 = a12 / r11, r22 = std::sqrt(a22 - r21 * r21);
  const Matrix2 root{r11, 0, r21, r22};
  const SingularValues svd(product({q.ux, q.vx, q.uy, q.vy}, root));

  const double s1 = svd.s1, s2 = svd.s2;
  const double f = 0.5 * (s1 / s2 + s2 / s1);
  const Penalty h = psi(f);
  const double f1 = 0.5 * (s1 - s2) * (s1 + s2) / (s1 * s1 * s2);
  const double f2 = -0.5 * (s1 - s2) * (s1 + s2) / (s1 * s2 * s2);
  const double f12 = -0.5 * (1 / (s1 * s1) + 1 / (s2 * s2));
  const Scaling scaling(h.slope * s2 / (s1 * s1 * s1) + h.curvature * f1 * f1,
                        h.slope * f12 + h.curvature * f1 * f2,
                        h.slope * s1 / (s2 * s2 * s2) + h.curvature * f2 * f2);
  const double flip = h.slope * (s1 + s2) * (s1 + s2) / (2 * s1 * s1 * s2 * s2);
  const double half_root = std::sqrt(0.5);
  add_rank_one(weight * flip, svd.between({0, half_root, half_root, 0}), root, out);
  add_rank_one(weight * scaling.eigenvalue, svd.between({scaling.x, 0, 0, scaling.y}), root, out);
  return out;
}

}  // namespace winslow::distortion
