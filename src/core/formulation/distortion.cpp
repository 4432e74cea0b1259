#include "core/formulation/distortion.h"

#include <Eigen/LU>

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

/// Adds the rank-one part lambda q q^T. m: eigenvector over J.
void add_rank_one(double lambda, const Matrix2& m, const Matrix2& root, double* blocks) {
  if (!(lambda > 0)) return;
  // <m, dJ> = <m, [du dv] root> = <m root^T, [du dv]>: one vector for each edge.
  const Matrix2 q = times_transposed(m, root);
  const double b[2] = {q.a, q.c}, c[2] = {q.b, q.d}, a[2] = {-q.a - q.b, -q.c - q.d};
  const auto add_outer = [&](std::ptrdiff_t place, const double* v, const double* w) {
    double* block = blocks + place;
    block[0] += lambda * v[0] * w[0];
    block[1] += lambda * v[0] * w[1];
    block[2] += lambda * v[1] * w[0];
    block[3] += lambda * v[1] * w[1];
  };
  add_outer(TriangleSum::ab, a, b);
  add_outer(TriangleSum::ac, a, c);
  add_outer(TriangleSum::bc, b, c);
}

}  // namespace

void add_projected_blocks(const Corner2& q, const ShapeTerm& term, const PenaltyFunction& psi,
                          double inverse_limit, double* blocks) {
  // The metric over the edges (u, v) is A = root root^T: J = [u v] root.
  const double a11 = term.ab + term.bc, a12 = -term.bc, a22 = term.ac + term.bc;
  const double r11 = std::sqrt(a11), r21 = a12 / r11, r22 = std::sqrt(a22 - r21 * r21);
  const Matrix2 root{r11, 0, r21, r22};
  const SingularValues svd(product({q.ux, q.vx, q.uy, q.vy}, root));

  const double s1 = svd.s1, s2 = svd.s2;
  const double f = 0.5 * (s1 / s2 + s2 / s1);
  const PenaltySlopes h = psi.slopes(f, inverse_limit);
  const double f1 = 0.5 * (s1 - s2) * (s1 + s2) / (s1 * s1 * s2);
  const double f2 = -0.5 * (s1 - s2) * (s1 + s2) / (s1 * s2 * s2);
  const double f12 = -0.5 * (1 / (s1 * s1) + 1 / (s2 * s2));
  const Scaling scaling(h.first * s2 / (s1 * s1 * s1) + h.second * f1 * f1,
                        h.first * f12 + h.second * f1 * f2,
                        h.first * s1 / (s2 * s2 * s2) + h.second * f2 * f2);
  const double flip = h.first * (s1 + s2) * (s1 + s2) / (2 * s1 * s1 * s2 * s2);
  const double half_root = std::sqrt(0.5);
  add_rank_one(term.weight * flip, svd.between({0, half_root, half_root, 0}), root, blocks);
  add_rank_one(term.weight * scaling.eigenvalue, svd.between({scaling.x, 0, 0, scaling.y}), root,
               blocks);
}

void project_blocks(const Corner2& q, const CellTargets<2>& targets, std::size_t cell,
                    const PenaltyFunction& psi, double* sum) {
  std::fill(sum, sum + TriangleSum::corners, 0.0);
  for (auto k = at(targets.offsets[cell]); k < at(targets.offsets[cell + 1]); ++k)
    add_projected_blocks(q, targets.terms[k], psi, targets.inverse_limit(k), sum);
}

Corner3::Corner3(const std::array<Vec3, 4>& p) {
  for (int k = 0; k < 3; ++k) edges.col(k) = p[static_cast<std::size_t>(k + 1)] - p[0];
  d = edges.determinant();
}

double Corner3::distortion(const VolumeTerm& term) const {
  const double s = (edges.transpose() * edges).cwiseProduct(metric_of(term)).sum();
  return d > 0 ? s / (3 * std::cbrt(d) * std::cbrt(d)) : -1;
}

}  // namespace winslow::distortion
