#include "core/geometry/surface/smooth_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// A walk over the patches to the place whose connection with a point is at right angles to the
/// surface, by Newton's method on half the squared distance.
class Descent {
 public:
  Descent(const Triangulation& surface, std::span<const std::array<Index, 3>> neighbours,
          std::span<const SurfacePatch> patches, const Vec3& target)
      : surface_(surface), neighbours_(neighbours), patches_(patches), target_(target) {}

  TrianglePlace run(TrianglePlace place) {
    constexpr int most_steps = 50, most_turns = 12;
    constexpr double small = 1e-14;
    int turns = 0;  // from triangle to triangle without a step
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
  /// Of the barycentric coordinates. fixed: one of them that stays; -1: none.
  Vec3 newton_step(const TrianglePlace& place, int fixed) const {
    const auto d = patches_[at(place.triangle)].at(place.at[0], place.at[1]);
    const Vec3 off = d.r - target_;
    const Vec2 gradient(d.u.dot(off), d.v.dot(off));
    Eigen::Matrix2d metric, hessian;
    metric << d.u.dot(d.u), d.u.dot(d.v), d.u.dot(d.v), d.v.dot(d.v);
    hessian << d.uu.dot(off), d.uv.dot(off), d.uv.dot(off), d.vv.dot(off);
    hessian += metric;
    // Away from the surface there may be nothing to go down to: the metric alone always leads down.
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

  /// The coordinate that is zero and that a step would make negative; of several the one that falls
  /// fastest. -1: none.
  static int blocked_by(const TrianglePlace& place, const Vec3& step) {
    int blocked = -1;
    for (int k = 0; k < 3; ++k)
      if (place.at[k] <= 0 && step[k] < 0 && (blocked < 0 || step[k] < step[blocked])) blocked = k;
    return blocked;
  }

  /// As far as the triangle goes.
  static void advance(TrianglePlace& place, const Vec3& step) {
    double share = 1;
    int hit = -1;
    for (int k = 0; k < 3; ++k)
      if (place.at[k] + share * step[k] < 0) {
        share = place.at[k] / -step[k];
        hit = k;
      }
    place.at += share * step;
    if (hit >= 0) place.at[hit] = 0;
    for (int k = 0; k < 3; ++k) place.at[k] = std::max(0.0, place.at[k]);
    place.at /= place.at.sum();
  }

  /// To the triangle on the other side of the edge on which a coordinate is zero, if there is one.
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
          there[j] = place.at[k];
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
  const auto d = patches_[at(triangle)].at(place[0], place[1]);
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
  return over(place.triangle, place.at);
}

std::string SmoothSurface::description() const {
  return "smooth surface through " + std::to_string(surface_.points.size()) + " nodes";
}

}  // namespace winslow
