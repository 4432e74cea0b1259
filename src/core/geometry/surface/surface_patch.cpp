#include "core/geometry/surface/surface_patch.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

namespace winslow {

namespace {

/// A function of u and v with its derivatives.
struct Jet {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};

Jet operator*(const Jet& a, const Jet& b) {
  return {a.f * b.f,
          a.u * b.f + a.f * b.u,
          a.v * b.f + a.f * b.v,
          a.uu * b.f + 2 * a.u * b.u + a.f * b.uu,
          a.uv * b.f + a.u * b.v + a.v * b.u + a.f * b.uv,
          a.vv * b.f + 2 * a.v * b.v + a.f * b.vv};
}

Jet operator*(double c, const Jet& a) {
  return {c * a.f, c * a.u, c * a.v, c * a.uu, c * a.uv, c * a.vv};
}

Jet operator+(const Jet& a, const Jet& b) {
  return {a.f + b.f, a.u + b.u, a.v + b.v, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv};
}

Jet inverse(const Jet& a) {
  const double f = 1 / a.f, g = -f * f, h = 2 * f * f * f;
  return {f,
          g * a.u,
          g * a.v,
          h * a.u * a.u + g * a.uu,
          h * a.u * a.v + g * a.uv,
          h * a.v * a.v + g * a.vv};
}

/// The coordinates of the three vertices as functions of u and v.
std::array<Jet, 3> barycentric(double u, double v) {
  return {Jet{u, 1, 0}, Jet{v, 0, 1}, Jet{1 - u - v, -1, -1}};
}

/// b_l^2 b_m^2 b_n / (b_m + b_n): zero, with its first derivatives, where the divisor is.
Jet blend(const Jet& l, const Jet& m, const Jet& n) {
  const Jet sum = m + n;
  if (sum.f < 1e-12) return {};
  return (l * l) * (m * m) * n * inverse(sum);
}

/// Places in the list of points: 0 to 2 vertices; 3 + 3 e the three inner points of edge e, which
/// leads from vertex e to the next; 12 + 2 k the two of the inner point at vertex k, by the edge
/// that leaves it and by the one that comes to it.
constexpr std::size_t edge_place(std::size_t edge) { return 3 + 3 * edge; }
constexpr std::size_t inner_place(std::size_t vertex) { return 12 + 2 * vertex; }

std::array<Jet, 18> basis(double u, double v) {
  const std::array<Jet, 3> b = barycentric(u, v);
  std::array<Jet, 18> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Jet &l = b[k], &m = b[(k + 1) % 3], &n = b[(k + 2) % 3];
    const Jet ll = l * l, mm = m * m;
    out[k] = ll * ll;
    out[edge_place(k)] = 4 * (ll * l * m);
    out[edge_place(k) + 1] = 6 * (ll * mm);
    out[edge_place(k) + 2] = 4 * (l * m * mm);
    // The edge that leaves k has n = 0 and counts all there.
    out[inner_place(k)] = 12 * blend(l, m, n);
    out[inner_place(k) + 1] = 12 * blend(l, n, m);
  }
  return out;
}

struct QuarticEdge {
  std::array<Vec3, 4> cubic;
  std::array<Vec3, 5> quartic;
};

QuarticEdge elevated(const Vec3& a, const std::array<Vec3, 2>& inner, const Vec3& b) {
  const auto& [p, q] = inner;
  return {{a, p, q, b}, {a, 0.25 * a + 0.75 * p, 0.5 * (p + q), 0.75 * q + 0.25 * b, b}};
}

}  // namespace

std::array<Vec3, 2> edge_between(const Vec3& a, const Vec3& b, const Vec3& normal_a,
                                 const Vec3& normal_b) {
  const Vec3 chord = b - a;
  const double length = chord.norm();
  const Vec3 along = chord / length;
  const double c = normal_a.dot(normal_b), ca = normal_a.dot(along), cb = normal_b.dot(along);
  const double rho = 6 * (2 * ca + c * cb) / (4 - c * c);
  const double sigma = 6 * (2 * cb + c * ca) / (4 - c * c);
  return {a + (length / 18) * (6 * along - 2 * rho * normal_a + sigma * normal_b),
          b - (length / 18) * (6 * along + rho * normal_a - 2 * sigma * normal_b)};
}

SurfacePatch::SurfacePatch(const std::array<Vec3, 3>& vertices) : flat_(true) {
  for (std::size_t k = 0; k < 3; ++k) points_[k] = vertices[k];
}

SurfacePatch::SurfacePatch(const std::array<Vec3, 3>& vertices, const std::array<Vec3, 3>& normals)
    : SurfacePatch(vertices) {
  const Vec3 area = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
  constexpr double least_cosine = 0.5;
  for (const Vec3& normal : normals)
    if (!(normal.dot(area) >= least_cosine * area.norm()) || area.norm() == 0) return;

  std::array<QuarticEdge, 3> edges;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t f = (e + 1) % 3;
    edges[e] = elevated(vertices[e], edge_between(vertices[e], vertices[f], normals[e], normals[f]),
                        vertices[f]);
    for (std::size_t i = 0; i < 3; ++i) points_[edge_place(e) + i] = edges[e].quartic[i + 1];
  }
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t f = (e + 1) % 3;
    const auto& [v, q] = edges[e];
    const Vec3 w0 = v[1] - v[0], w1 = v[2] - v[1], w2 = v[3] - v[2];
    // Next to the ends of the edge, on the two others.
    const Vec3 &beside_start = edges[(e + 2) % 3].quartic[3], &beside_end = edges[f].quartic[1];
    const Vec3 d0 = beside_start - 0.5 * (q[0] + q[1]), d3 = beside_end - 0.5 * (q[3] + q[4]);
    const Vec3 a0 = normals[e].cross(w0).normalized(), a2 = normals[f].cross(w2).normalized();
    const Vec3 a1 = (a0 + a2).normalized();
    // Along the edge, the derivative across is a linear combination of its tangent and of a normal
    // to that which both triangles have in common; the factors are linear.
    const double l0 = d0.dot(w0) / w0.squaredNorm(), l1 = d3.dot(w2) / w2.squaredNorm();
    const double m0 = d0.dot(a0), m1 = d3.dot(a2);
    points_[inner_place(e)] =
        0.5 * (q[1] + q[2]) + (2 * l0 * w1 + l1 * w0 + 2 * m0 * a1 + m1 * a0) / 3;
    points_[inner_place(f) + 1] =
        0.5 * (q[2] + q[3]) + (l0 * w2 + 2 * l1 * w1 + m0 * a2 + 2 * m1 * a1) / 3;
  }
  flat_ = false;
  for (const Vec3& point : points_)
    if (!point.allFinite()) flat_ = true;
}

SurfacePatch::Derivatives SurfacePatch::at(double u, double v) const {
  if (flat_) {
    const Vec3 zero = Vec3::Zero();
    return {u * points_[0] + v * points_[1] + (1 - u - v) * points_[2],
            points_[0] - points_[2],
            points_[1] - points_[2],
            zero,
            zero,
            zero};
  }
  const std::array<Jet, 18> weights = basis(u, v);
  Derivatives out{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                  Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const Jet& w = weights[k];
    const Vec3& p = points_[k];
    out.r += w.f * p;
    out.u += w.u * p;
    out.v += w.v * p;
    out.uu += w.uu * p;
    out.uv += w.uv * p;
    out.vv += w.vv * p;
  }
  return out;
}

}  // namespace winslow
