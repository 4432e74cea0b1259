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

/// One term of the triangle (a, b, c): gradient at its corners and the off-diagonal blocks of its
/// Hessian, weight and power included. The others are their transposes; blocks of a row sum to
/// zero.
struct TriangleTerm {
  double value;
  Vector a, b, c;
  Block ab, ac, bc;
};

/// curvature_share: of the term -f S in the Hessian: 1 for the exact one, 0 for the part that is
/// convex by construction (f is quadratic over linear in the edges and in d).
inline TriangleTerm triangle_term(const Corner2& q, const Form& c, double weight,
                                  const PenaltyFunction& psi, const Determinant& chi,
                                  double curvature_share) {
  const double inverse = 1 / chi.value;
  const double f = 0.5 * q.form(c) * inverse;
  const Penalty h = psi(f);
  const double wx = q.vx - q.ux, wy = q.vy - q.uy;
  // D times the slope of chi: gradient of chi.
  const Vector Da{-chi.slope * wy, chi.slope * wx};
  const Vector Db{chi.slope * q.vy, -chi.slope * q.vx};
  const Vector Dc{-chi.slope * q.uy, chi.slope * q.ux};
  const Vector gb{(c.ij * q.ux - c.jk * wx - f * Db.x) * inverse,
                  (c.ij * q.uy - c.jk * wy - f * Db.y) * inverse};
  const Vector gc{(c.ik * q.vx + c.jk * wx - f * Dc.x) * inverse,
                  (c.ik * q.vy + c.jk * wy - f * Dc.y) * inverse};
  const Vector ga{-gb.x - gc.x, -gb.y - gc.y};
  const double slope = weight * h.slope;
  const double first = slope * inverse;
  const double second = weight * h.curvature;
  const double s = first * curvature_share * f;
  const auto block = [&](double l, double sij, const Vector& g, const Vector& D, const Vector& k,
                         const Vector& E) {
    return Block{first * (l - (g.x * E.x + D.x * k.x)) + second * g.x * k.x,
                 first * -(g.x * E.y + D.x * k.y) + second * g.x * k.y - sij,
                 first * -(g.y * E.x + D.y * k.x) + second * g.y * k.x + sij,
                 first * (l - (g.y * E.y + D.y * k.y)) + second * g.y * k.y};
  };
  return {weight * h.value,
          {slope * ga.x, slope * ga.y},
          {slope * gb.x, slope * gb.y},
          {slope * gc.x, slope * gc.y},
          block(-c.ij, s, ga, Da, gb, Db),
          block(-c.ik, -s, ga, Da, gc, Dc),
          block(-c.jk, s, gb, Db, gc, Dc)};
}

/// A term with its Hessian projected to positive semidefinite, in closed form.
///
/// psi(f) depends on the singular values s1 >= s2 of J alone, so the eigenvectors of its Hessian
/// over J are known (B. Smith, F. de Goes, T. Kim, "Analytic Eigensystems for Isotropic Distortion
/// Energies", ACM TOG 38(1), 2019): a twist (eigenvalue (psi_1 + psi_2) / (s1 + s2), never positive
/// here), a flip ((psi_1 - psi_2) / (s1 - s2), always positive) and two scalings, of which
/// exactly one is positive because psi does not change with size.
TriangleTerm projected_triangle_term(const Corner2& q, const Form& c, double weight,
                                     const PenaltyFunction& psi);

}  // namespace winslow::distortion
