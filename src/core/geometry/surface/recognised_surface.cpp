#include "core/geometry/surface/recognised_surface.h"

#include <Eigen/Dense>
#include <utility>

#include "core/geometry/surface/surface.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

class Plane final : public Surface {
 public:
  Plane(const Vec3& origin, const Vec3& normal) : origin_(origin), normal_(normal) {}
  SurfacePoint nearest(const Vec3& p) const override {
    SurfacePoint out;  // what the plane does not say keeps its bits
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

/// All triangles face along the normals of the candidate, or all against them.
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

/// Least squares of |p|^2 = 2 c . p + (r^2 - c^2), about the mean of the points.
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

/// One Gauss-Newton step of the distances of all points from the axis less the radius.
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

/// The axis is at right angles to all triangles' normals, so far as they are its tangent planes.
std::unique_ptr<const Surface> cylinder_of(const Triangulation& surface, const Vec3& mean) {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const auto& t : surface.triangles) {
    const Vec3 area = area_of(surface, t);
    if (area.norm() > 0) normals += area * area.transpose() / area.norm();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normals);
  CylinderFit fit{mean, eigen.eigenvectors().col(0), 0};
  // Where the axis lies: the least squares of a circle in the plane across it.
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
  Box<3> box = Box<3>::empty();
  Vec3 mean(0, 0, 0);
  for (const Vec3& p : surface.points) {
    box.add(p);
    mean += p;
  }
  mean /= static_cast<double>(surface.points.size());
  const double extent = box.size().norm(), allowed = tolerance * extent;
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
