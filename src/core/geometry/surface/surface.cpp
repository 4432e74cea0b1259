#include "core/geometry/surface/surface.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <utility>

#include "core/options/option.h"
#include "core/parallel/parallel_for.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// A function and its derivatives by two of the barycentric coordinates, l and m.
struct Jet {
  double f = 0, l = 0, m = 0, ll = 0, lm = 0, mm = 0;
};

/// Places in the list of points: 0 to 2 vertices; 3 + 3 e the three inner points of edge e, which
/// leads from vertex e to the next; 12 + 2 k the two of the inner point at vertex k, by the edge
/// that leaves it and by the one that comes to it.
constexpr std::size_t edge_place(std::size_t edge) { return 3 + 3 * edge; }
constexpr std::size_t inner_place(std::size_t vertex) { return 12 + 2 * vertex; }

/// A sum of points times functions, and its derivatives.
struct PointJet {
  Vec3 f = Vec3::Zero(), l = Vec3::Zero(), m = Vec3::Zero();
  Vec3 ll = Vec3::Zero(), lm = Vec3::Zero(), mm = Vec3::Zero();

  void add(const Jet& weight, const Vec3& p) {
    f += weight.f * p;
    l += weight.l * p;
    m += weight.m * p;
    ll += weight.ll * p;
    lm += weight.lm * p;
    mm += weight.mm * p;
  }
};

/// The terms of the patch that belong to vertex k. l, m and n are the barycentric coordinates of k
/// and of the two vertices after it. The weights are l^4 for the vertex; 4 l^3 m, 6 l^2 m^2 and 4 l
/// m^3 for the inner points of the edge from k to the next vertex; and 12 l^2 m n / (m + n) times m
/// and n for the two inner points at k. The last two are zero, with their first derivatives, where
/// m + n = 0.
PointJet part_of_vertex(const std::array<Vec3, 18>& points, std::size_t k, double l, double m,
                        double n) {
  const double ll = l * l, lm = l * m, mm = m * m;
  PointJet sum;
  sum.add({ll * ll, 4 * ll * l, 0, 12 * ll, 0, 0}, points[k]);
  const Vec3* edge = &points[edge_place(k)];
  sum.add({4 * ll * lm, 12 * l * lm, 4 * ll * l, 24 * lm, 12 * ll, 0}, edge[0]);
  sum.add({6 * lm * lm, 12 * lm * m, 12 * lm * l, 12 * mm, 24 * lm, 12 * ll}, edge[1]);
  sum.add({4 * lm * mm, 4 * mm * m, 12 * lm * m, 0, 12 * mm, 24 * lm}, edge[2]);
  const double s = m + n;
  if (s < 1e-12) return sum;
  // q = 12 l^2 / (1 - l) by l alone, times m^2 n and m n^2, where n = 1 - l - m.
  const double q = 12 * ll / s, q1 = 12 * l * (1 + s) / (s * s), q2 = 24 / (s * s * s);
  const Vec3* inner = &points[inner_place(k)];
  const double mn = m * n, nn = n * n;
  sum.add({q * (m * mn), q1 * (m * mn) - q * mm, q * (2 * mn - mm), q2 * (m * mn) - 2 * (q1 * mm),
           q1 * (2 * mn - mm) - 2 * (q * m), q * (2 * n - 4 * m)},
          inner[0]);
  sum.add({q * (n * mn), q1 * (n * mn) - 2 * (q * mn), q * (nn - 2 * mn),
           q2 * (n * mn) - 4 * (q1 * mn) + 2 * (q * m), q1 * (nn - 2 * mn) + 2 * (q * (m - n)),
           q * (2 * m - 4 * n)},
          inner[1]);
  return sum;
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
    // The Bezier points next to the ends of the edge on the other two edges.
    const Vec3 &beside_start = edges[(e + 2) % 3].quartic[3], &beside_end = edges[f].quartic[1];
    const Vec3 d0 = beside_start - 0.5 * (q[0] + q[1]), d3 = beside_end - 0.5 * (q[3] + q[4]);
    const Vec3 a0 = normals[e].cross(w0).normalized(), a2 = normals[f].cross(w2).normalized();
    const Vec3 a1 = (a0 + a2).normalized();
    // Along the edge, the derivative across it is a combination, with linear factors, of its
    // tangent and of a normal to it that is the same for both triangles.
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

SurfacePatch::Derivatives SurfacePatch::derivatives(double u, double v) const {
  if (flat_) {
    const Vec3 zero = Vec3::Zero();
    return {u * points_[0] + v * points_[1] + (1 - u - v) * points_[2],
            points_[0] - points_[2],
            points_[1] - points_[2],
            zero,
            zero,
            zero};
  }
  const double w = 1 - u - v;
  // By (u, v), (v, w) and (w, u).
  const PointJet a = part_of_vertex(points_, 0, u, v, w);
  const PointJet b = part_of_vertex(points_, 1, v, w, u);
  const PointJet c = part_of_vertex(points_, 2, w, u, v);
  return {a.f + b.f + c.f,
          a.l - b.m + (c.m - c.l),
          a.m + (b.l - b.m) - c.l,
          a.ll + b.mm + (c.ll - 2 * c.lm + c.mm),
          a.lm + (b.mm - b.lm) + (c.ll - c.lm),
          a.mm + (b.ll - 2 * b.lm + b.mm) + c.ll};
}

namespace {

/// Finds the nearest point of the surface, by Newton's method on half the squared distance from
/// patch to patch.
class Descent {
 public:
  Descent(const Triangulation& surface, std::span<const std::array<Index, 3>> neighbours,
          std::span<const SurfacePatch> patches, const Vec3& target)
      : surface_(surface), neighbours_(neighbours), patches_(patches), target_(target) {}

  TrianglePlace run(TrianglePlace place) {
    constexpr int most_steps = 50, most_turns = 12;
    constexpr double small = 1e-14;
    int turns = 0;  // changes of the triangle without a step
    for (int i = 0; i < most_steps && turns < most_turns; ++i) {
      Vec3 step = newton_step(place, -1);
      const int blocked = blocked_by(place, step);
      if (blocked >= 0) {
        if (cross(place, blocked)) {
          ++turns;
          continue;
        }
        step = newton_step(place, blocked);
        if (blocked_by(place, step) >= 0) break;
      }
      const double length = step.lpNorm<Eigen::Infinity>();
      advance(place, step);
      if (length <= small) break;
      turns = 0;
    }
    return place;
  }

 private:
  /// A step of the barycentric coordinates. fixed: a coordinate that stays; -1: none.
  Vec3 newton_step(const TrianglePlace& place, int fixed) const {
    const auto d =
        patches_[at(place.triangle)].derivatives(place.barycentric[0], place.barycentric[1]);
    const Vec3 off = d.r - target_;
    const Vec2 gradient(d.u.dot(off), d.v.dot(off));
    Eigen::Matrix2d metric, hessian;
    metric << d.u.dot(d.u), d.u.dot(d.v), d.u.dot(d.v), d.v.dot(d.v);
    hessian << d.uu.dot(off), d.uv.dot(off), d.uv.dot(off), d.vv.dot(off);
    hessian += metric;
    // Far from the surface the Hessian may be indefinite; the metric always gives a descent.
    if (!(hessian.determinant() > 0.1 * metric.determinant() && hessian.trace() > 0))
      hessian = metric;
    if (fixed < 0) {
      const Vec2 s = -hessian.inverse() * gradient;
      return s.allFinite() ? Vec3(s[0], s[1], -s[0] - s[1]) : Vec3(0, 0, 0);
    }
    static const std::array<Vec3, 3> along{Vec3(0, 1, -1), Vec3(-1, 0, 1), Vec3(1, -1, 0)};
    const Vec3& edge = along[static_cast<std::size_t>(fixed)];
    const Vec2 e = edge.head<2>();
    const double curvature = e.dot(hessian * e);
    return curvature > 0 ? Vec3(-(e.dot(gradient) / curvature) * edge) : Vec3(0, 0, 0);
  }

  /// The coordinate that is zero and would become negative, of several the fastest one; -1: none.
  static int blocked_by(const TrianglePlace& place, const Vec3& step) {
    int blocked = -1;
    for (int k = 0; k < 3; ++k)
      if (place.barycentric[k] <= 0 && step[k] < 0 && (blocked < 0 || step[k] < step[blocked]))
        blocked = k;
    return blocked;
  }

  /// Makes a step, but not beyond the triangle.
  static void advance(TrianglePlace& place, const Vec3& step) {
    double share = 1;
    int hit = -1;
    for (int k = 0; k < 3; ++k)
      if (place.barycentric[k] + share * step[k] < 0) {
        share = place.barycentric[k] / -step[k];
        hit = k;
      }
    place.barycentric += share * step;
    if (hit >= 0) place.barycentric[hit] = 0;
    for (int k = 0; k < 3; ++k) place.barycentric[k] = std::max(0.0, place.barycentric[k]);
    place.barycentric /= place.barycentric.sum();
  }

  /// Changes to the triangle beyond the edge on which a coordinate is zero. False if there is none.
  bool cross(TrianglePlace& place, int zero) const {
    const auto& from = surface_.triangles[at(place.triangle)];
    const auto edge = static_cast<std::size_t>((zero + 1) % 3);
    const Index next = neighbours_[at(place.triangle)][edge];
    if (next < 0) return false;
    const auto& to = surface_.triangles[at(next)];
    Vec3 there(0, 0, 0);
    for (int k = 0; k < 3; ++k) {
      if (k == zero) continue;
      for (int j = 0; j < 3; ++j)
        if (to[static_cast<std::size_t>(j)] == from[static_cast<std::size_t>(k)])
          there[j] = place.barycentric[k];
    }
    place = {next, there};
    return true;
  }

  const Triangulation& surface_;
  std::span<const std::array<Index, 3>> neighbours_;
  std::span<const SurfacePatch> patches_;
  Vec3 target_;
};

}  // namespace

SmoothSurface::SmoothSurface(Triangulation surface, std::span<const Vec3> normals)
    : surface_(std::move(surface)), neighbours_(triangle_neighbours(surface_)), tree_(surface_) {
  patches_.resize(surface_.triangles.size(),
                  SurfacePatch({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}));
  parallel_for(0, static_cast<Index>(patches_.size()), [&](Index begin, Index end) {
    for (std::size_t t = at(begin); t < at(end); ++t) {
      const auto& [a, b, c] = surface_.triangles[t];
      const std::array<Vec3, 3> corners{surface_.points[at(a)], surface_.points[at(b)],
                                        surface_.points[at(c)]};
      patches_[t] = {corners, {normals[at(a)], normals[at(b)], normals[at(c)]}};
    }
  });
}

TrianglePlace SmoothSurface::nearest_place(const Vec3& point) const {
  return Descent(surface_, neighbours_, patches_, point).run(tree_.nearest(surface_, point));
}

SurfacePoint SmoothSurface::over(Index triangle, const Vec3& place) const {
  const auto d = patches_[at(triangle)].derivatives(place[0], place[1]);
  SurfacePoint out;
  out.point = d.r;
  out.normal = d.u.cross(d.v).normalized();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << d.u, d.v;
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  const Eigen::Matrix<double, 2, 3> dual = metric.inverse() * tangents.transpose();
  Eigen::Matrix2d form;
  form << out.normal.dot(d.uu), out.normal.dot(d.uv), out.normal.dot(d.uv), out.normal.dot(d.vv);
  out.form = dual.transpose() * form * dual;
  return out;
}

SurfacePoint SmoothSurface::nearest(const Vec3& point) const {
  const TrianglePlace place = nearest_place(point);
  return over(place.triangle, place.barycentric);
}

std::string SmoothSurface::description() const {
  return "smooth surface through " + std::to_string(surface_.points.size()) + " nodes";
}

namespace {

class Plane final : public Surface {
 public:
  Plane(const Vec3& origin, const Vec3& normal) : origin_(origin), normal_(normal) {}
  SurfacePoint nearest(const Vec3& p) const override {
    SurfacePoint out;
    out.point = p - normal_.dot(p - origin_) * normal_;
    out.normal = normal_;
    return out;
  }
  bool goes_on() const override { return true; }
  std::string description() const override { return "plane"; }

 private:
  Vec3 origin_, normal_;
};

class Sphere final : public Surface {
 public:
  Sphere(const Vec3& centre, double radius) : centre_(centre), radius_(radius) {}
  SurfacePoint nearest(const Vec3& p) const override {
    const Vec3 arm = p - centre_;
    const double length = arm.norm();
    SurfacePoint out;
    out.normal = length > 0 ? Vec3(arm / length) : Vec3(0, 0, 1);
    out.point = centre_ + radius_ * out.normal;
    out.form = -(Eigen::Matrix3d::Identity() - out.normal * out.normal.transpose()) / radius_;
    return out;
  }
  bool goes_on() const override { return true; }
  std::string description() const override { return "sphere of radius " + number_text(radius_); }

 private:
  Vec3 centre_;
  double radius_;
};

class Cylinder final : public Surface {
 public:
  Cylinder(const Vec3& centre, const Vec3& axis, double radius)
      : centre_(centre), axis_(axis), radius_(radius) {}
  SurfacePoint nearest(const Vec3& p) const override {
    const double height = axis_.dot(p - centre_);
    const Vec3 foot = centre_ + height * axis_, arm = p - foot;
    const double length = arm.norm();
    SurfacePoint out;
    out.normal = length > 0 ? Vec3(arm / length) : axis_.unitOrthogonal();
    out.point = foot + radius_ * out.normal;
    const Vec3 around = axis_.cross(out.normal);
    out.form = -(around * around.transpose()) / radius_;
    return out;
  }
  bool goes_on() const override { return true; }
  std::string description() const override { return "cylinder of radius " + number_text(radius_); }

 private:
  Vec3 centre_, axis_;
  double radius_;
};

Vec3 area_of(const Triangulation& surface, const std::array<Index, 3>& t) {
  const Vec3& a = surface.points[at(t[0])];
  return 0.5 * (surface.points[at(t[1])] - a).cross(surface.points[at(t[2])] - a);
}

bool all_near(const Triangulation& surface, const Surface& candidate, double tolerance) {
  for (const Vec3& p : surface.points)
    if (!((candidate.nearest(p).point - p).norm() <= tolerance)) return false;
  return true;
}

/// Whether all triangles face along the normals of the candidate, or all against them.
bool faces_along(const Triangulation& surface, const Surface& candidate) {
  constexpr double least_cosine = 0.7;
  int side = 0;
  for (const auto& t : surface.triangles) {
    const Vec3 area = area_of(surface, t);
    const Vec3 centre =
        (surface.points[at(t[0])] + surface.points[at(t[1])] + surface.points[at(t[2])]) / 3;
    const double cosine = area.dot(candidate.nearest(centre).normal);
    if (!(std::abs(cosine) >= least_cosine * area.norm())) return false;
    const int here = cosine > 0 ? 1 : -1;
    if (side != 0 && here != side) return false;
    side = here;
  }
  return true;
}

std::unique_ptr<const Surface> plane_of(const Triangulation& surface) {
  Vec3 normal(0, 0, 0);
  for (const auto& t : surface.triangles) normal += area_of(surface, t);
  if (normal.norm() == 0) return nullptr;
  return std::make_unique<Plane>(surface.points.front(), normal.normalized());
}

/// Fits |p|^2 = 2 c . p + (r^2 - c^2) by least squares, relative to the mean of the points.
std::unique_ptr<const Surface> sphere_of(const Triangulation& surface, const Vec3& mean,
                                         double extent) {
  const auto rows = static_cast<Eigen::Index>(surface.points.size());
  Eigen::Matrix<double, Eigen::Dynamic, 4> a(rows, 4);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 p = (surface.points[static_cast<std::size_t>(i)] - mean) / extent;
    a.row(i) << 2 * p.transpose(), 1;
    b[i] = p.squaredNorm();
  }
  const Eigen::Vector4d s = a.colPivHouseholderQr().solve(b);
  const double radius = std::sqrt(s[3] + s.head<3>().squaredNorm());
  if (!std::isfinite(radius)) return nullptr;
  return std::make_unique<Sphere>(mean + extent * s.head<3>(), extent * radius);
}

struct CylinderFit {
  Vec3 centre, axis;
  double radius;
};

/// A Gauss-Newton step for the sum of the squares of (distance from the axis - radius) over all
/// points.
std::optional<CylinderFit> improved(const Triangulation& surface, const CylinderFit& fit) {
  const Vec3 first = fit.axis.unitOrthogonal(), second = fit.axis.cross(first);
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> rhs = Eigen::Matrix<double, 5, 1>::Zero();
  for (const Vec3& p : surface.points) {
    const Vec3 arm = p - fit.centre;
    const double height = fit.axis.dot(arm);
    const Vec3 off = arm - height * fit.axis;
    const double length = off.norm();
    if (length == 0) return std::nullopt;
    const double x = first.dot(off) / length, y = second.dot(off) / length;
    const double h = height / fit.radius;
    Eigen::Matrix<double, 5, 1> row;  // centre along both, axis turned to both, radius
    row << -x, -y, -h * x, -h * y, -1;
    normal += row * row.transpose();
    rhs -= row * (length - fit.radius);
  }
  const Eigen::Matrix<double, 5, 1> s = normal.ldlt().solve(rhs);
  if (!s.allFinite()) return std::nullopt;
  return CylinderFit{
      fit.centre + s[0] * first + s[1] * second,
      (fit.axis + (s[2] / fit.radius) * first + (s[3] / fit.radius) * second).normalized(),
      fit.radius + s[4]};
}

/// Starts with the axis that is most nearly perpendicular to the normals of the triangles.
std::unique_ptr<const Surface> cylinder_of(const Triangulation& surface, const Vec3& mean) {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const auto& t : surface.triangles) {
    const Vec3 area = area_of(surface, t);
    if (area.norm() > 0) normals += area * area.transpose() / area.norm();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normals);
  CylinderFit fit{mean, eigen.eigenvectors().col(0), 0};
  // The position of the axis: a circle fit in the plane perpendicular to it.
  const Vec3 first = fit.axis.unitOrthogonal(), second = fit.axis.cross(first);
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vec3 b(0, 0, 0);
  double scale = 0;
  for (const Vec3& p : surface.points) scale = std::max(scale, (p - mean).norm());
  for (const Vec3& p : surface.points) {
    const Vec3 row(2 * first.dot(p - mean) / scale, 2 * second.dot(p - mean) / scale, 1);
    a += row * row.transpose();
    b += row * (row.head<2>().squaredNorm() / 4);
  }
  const Vec3 s = a.ldlt().solve(b);
  fit.centre += scale * (s[0] * first + s[1] * second);
  fit.radius = scale * std::sqrt(s[2] + s.head<2>().squaredNorm());
  constexpr int most_steps = 20;
  for (int i = 0; i < most_steps; ++i) {
    if (!(std::isfinite(fit.radius) && fit.radius > 0)) return nullptr;
    const auto next = improved(surface, fit);
    if (!next) return nullptr;
    const bool done = std::abs(next->radius - fit.radius) <= 1e-15 * fit.radius &&
                      (next->axis - fit.axis).norm() <= 1e-15;
    fit = *next;
    if (done) break;
  }
  return std::make_unique<Cylinder>(fit.centre, fit.axis, fit.radius);
}

}  // namespace

std::unique_ptr<const Surface> recognised_surface(const Triangulation& surface, double tolerance) {
  if (surface.triangles.empty()) return nullptr;
  const Vec3 mean = mean_of<3>(surface.points);
  const double extent = Box<3>::around(surface.points).size().norm();
  const double allowed = tolerance * extent;
  auto plane = plane_of(surface);
  if (plane && all_near(surface, *plane, allowed)) return plane;
  constexpr std::size_t least_points = 10;
  if (surface.points.size() < least_points) return nullptr;
  const auto fits = [&](const std::unique_ptr<const Surface>& candidate) {
    return candidate && all_near(surface, *candidate, allowed) && faces_along(surface, *candidate);
  };
  if (auto sphere = sphere_of(surface, mean, extent); fits(sphere)) return sphere;
  if (auto cylinder = cylinder_of(surface, mean); fits(cylinder)) return cylinder;
  return nullptr;
}

std::unique_ptr<const Surface> surface_through(Triangulation surface,
                                               std::span<const Vec3> tangents) {
  if (auto recognised = recognised_surface(surface)) return recognised;
  const std::vector<Vec3> normals = point_normals(surface, tangents);
  return std::make_unique<SmoothSurface>(std::move(surface), normals);
}

}  // namespace winslow
