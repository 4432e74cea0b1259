#pragma once

#include <cmath>

#include "core/formulation/target_shapes.h"
#include "core/types.h"

/// Distortion of one triangle against one target, and its derivatives with respect to the corners.
///
/// With the corners (i, j, k) counter-clockwise, u = x_j - x_i, v = x_k - x_i, d = u x v and the
/// target's form N = ij |u|^2 + ik |v|^2 + jk |v - u|^2:
///
///   f = N / (2 d),   g_i = df/dx_i = (n_i - 2 f D_i) / (2 d),   n = dN/dx,  D = dd/dx,
///   H_ij = d2f/dx_i dx_j = (1/d) [ L_ij I - f S_ij - g_i D_j^T - D_i g_j^T ],
///
/// L the target's graph Laplacian (L_ij = -ij), S_ij = d2d/dx_i dx_j = [[0, 1], [-1, 0]] for i
/// before j. Blocks of a row sum to zero: a translation changes nothing.
namespace winslow::distortion {

/// The target's form with the node in question first.
struct Form {
  double ij, ik, jk;
};

inline Form form_at(const ShapeTerm& t, Index local) {
  if (local == 0) return {t.ab, t.ac, t.bc};
  if (local == 1) return {t.bc, t.ab, t.ac};
  return {t.ac, t.bc, t.ab};
}

/// Two edges at a corner and the determinant.
struct Corner2 {
  double ux, uy, vx, vy, d;

  Corner2(const double* xi, const double* xj, const double* xk)
      : ux(xj[0] - xi[0]),
        uy(xj[1] - xi[1]),
        vx(xk[0] - xi[0]),
        vy(xk[1] - xi[1]),
        d(ux * vy - uy * vx) {}

  /// |u| + |v|.
  double edges() const { return std::sqrt(ux * ux + uy * uy) + std::sqrt(vx * vx + vy * vy); }

  double form(const Form& c) const {
    const double wx = vx - ux, wy = vy - uy;
    return c.ij * (ux * ux + uy * uy) + c.ik * (vx * vx + vy * vy) + c.jk * (wx * wx + wy * wy);
  }
};

/// psi(f) = f + (f / knee)^p, or f^p without a knee, and its first two derivatives.
struct Penalty {
  double value, slope, curvature;
};

/// The penalty with what does not depend on f worked out once.
class PenaltyFunction {
 public:
  PenaltyFunction(double exponent, double knee)
      : exponent_(exponent),
        linear_(knee > 0 ? 1 : 0),
        scale_(knee > 0 ? std::pow(knee, -exponent) : 1) {
    const double whole = std::round(exponent);
    if (whole == exponent && whole >= 2 && whole <= 32) {
      integer_ = static_cast<unsigned>(whole) - 2;
    } else {
      integer_ = general;
    }
  }

  Penalty operator()(double f) const {
    const double f_p2 = scale_ * low_power(f);
    return {linear_ * f + f_p2 * f * f, linear_ + exponent_ * f_p2 * f,
            exponent_ * (exponent_ - 1) * f_p2};
  }

 private:
  static constexpr unsigned general = ~0U;

  /// f^(p-2).
  double low_power(double f) const {
    if (integer_ == general) return std::pow(f, exponent_ - 2);
    double result = 1, square = f;
    for (unsigned n = integer_; n != 0; n >>= 1U, square *= square) {
      if ((n & 1U) != 0) result *= square;
    }
    return result;
  }

  double exponent_, linear_, scale_;
  unsigned integer_ = general;
};

/// chi(d) and its slope; d itself where nothing is regularised.
struct Determinant {
  double value, slope;
};

inline Determinant regularised(double d, double e) {
  const double root = std::sqrt(e * e + d * d);
  // For d < 0 the sum cancels: chi = e^2 / (2 (root - d)).
  const double chi = d >= 0 ? 0.5 * (d + root) : 0.5 * e * e / (root - d);
  return {chi, root > 0 ? chi / root : 0.5};
}

struct Vector {
  double x, y;
};
/// 2x2, row-major.
struct Block {
  double xx = 0, xy = 0, yx = 0, yy = 0;
  Block& operator+=(const Block& o) {
    xx += o.xx;
    xy += o.xy;
    yx += o.yx;
    yy += o.yy;
    return *this;
  }
};

/// Row i of one term: gradient and the two off-diagonal blocks, weight and power included. The
/// diagonal block is minus their sum.
struct RowTerm {
  double value;
  Vector gradient;
  Block ij, ik;
};

/// curvature_share: of the term -f S in the Hessian: 1 for the exact one, 0 for the part that is
/// convex by construction (f is quadratic over linear in the edges and in d).
inline RowTerm row_term(const Corner2& q, const Form& c, double weight, const PenaltyFunction& psi,
                        const Determinant& chi, double curvature_share) {
  const double inverse = 1 / chi.value;
  const double f = 0.5 * q.form(c) * inverse;
  const Penalty h = psi(f);
  const double wx = q.vx - q.ux, wy = q.vy - q.uy;
  // D times the slope of chi: gradient of chi.
  const Vector Di{-chi.slope * wy, chi.slope * wx};
  const Vector Dj{chi.slope * q.vy, -chi.slope * q.vx};
  const Vector Dk{-chi.slope * q.uy, chi.slope * q.ux};
  const Vector gj{(c.ij * q.ux - c.jk * wx - f * Dj.x) * inverse,
                  (c.ij * q.uy - c.jk * wy - f * Dj.y) * inverse};
  const Vector gk{(c.ik * q.vx + c.jk * wx - f * Dk.x) * inverse,
                  (c.ik * q.vy + c.jk * wy - f * Dk.y) * inverse};
  const Vector gi{-gj.x - gk.x, -gj.y - gk.y};
  const double first = weight * h.slope * inverse;
  const double second = weight * h.curvature;
  const double s = first * curvature_share * f;
  const auto block = [&](double l, double sij, const Vector& gb, const Vector& Db) {
    return Block{first * (l - (gi.x * Db.x + Di.x * gb.x)) + second * gi.x * gb.x,
                 first * -(gi.x * Db.y + Di.x * gb.y) + second * gi.x * gb.y - sij,
                 first * -(gi.y * Db.x + Di.y * gb.x) + second * gi.y * gb.x + sij,
                 first * (l - (gi.y * Db.y + Di.y * gb.y)) + second * gi.y * gb.y};
  };
  const double slope = weight * h.slope;
  return {weight * h.value,
          {slope * gi.x, slope * gi.y},
          block(-c.ij, s, gj, Dj),
          block(-c.ik, -s, gk, Dk)};
}

/// Row i of a term with its Hessian projected to positive semidefinite, in closed form.
///
/// psi(f) depends on the singular values s1 >= s2 of J alone, so the eigenvectors of its Hessian
/// over J are known (B. Smith, F. de Goes, T. Kim, "Analytic Eigensystems for Isotropic Distortion
/// Energies", ACM TOG 38(1), 2019): a twist (eigenvalue (psi_1 + psi_2) / (s1 + s2), never positive
/// here), a flip ((psi_1 - psi_2) / (s1 - s2), always positive) and two scalings, of which
/// exactly one is positive because psi does not change with size.
RowTerm projected_row_term(const Corner2& q, const Form& c, double weight,
                           const PenaltyFunction& psi);

}  // namespace winslow::distortion
