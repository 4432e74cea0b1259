#include "io/format/mesh_in_space.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "io/text/numbers.h"

namespace winslow::io {
namespace {

constexpr double noise = 1e-9;  // of the extent

using PointMap = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;

PointMap points_of(const std::vector<double>& xyz) {
  return {xyz.data(), 3, static_cast<Eigen::Index>(xyz.size() / 3)};
}

/// Allowed distance of points from their plane. Far from the origin, rounding of coordinates
/// exceeds the noise that is accepted near it.
double tolerance_of(const PointMap& points) {
  const double extent = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
  return noise * extent + round_off * points.cwiseAbs().maxCoeff();
}

/// True if all points have the same coordinate along this axis.
bool constant_along(const PointMap& points, int axis, double tolerance) {
  return ((points.row(axis).array() - points(axis, 0)).abs() <= tolerance).all();
}

struct Axes {
  Vec3 u, v;
};

/// The axes defined at PlanePlacement; the normal may have either sign.
Axes axes_of(Vec3 normal) {
  int largest = 2;
  // For planes at 45 degrees, round-off must not decide the choice.
  constexpr double clearly = 1 + 1e-6;
  if (std::abs(normal[1]) > clearly * std::abs(normal[largest])) largest = 1;
  if (std::abs(normal[0]) > clearly * std::abs(normal[largest])) largest = 0;
  if ((normal[largest] > 0) == (largest == 1)) normal = -normal;
  const Vec3 first = Vec3::Unit(largest == 0 ? 1 : 0);
  const Vec3 u = (first - normal.dot(first) * normal).normalized();
  return {u, normal.cross(u)};
}

/// The plane with the least sum of squared distances.
struct FittedPlane {
  explicit FittedPlane(const PointMap& points) : centre(points.rowwise().mean()) {
    const Eigen::Matrix3Xd arms = points.colwise() - centre;
    const Eigen::Matrix3d moments = arms * arms.transpose();
    normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
    distance = (normal.transpose() * arms).cwiseAbs().maxCoeff();
  }
  Vec3 centre, normal;
  double distance = 0;  // distance of the farthest point
};

std::string rounded_text(double value) {
  std::string text;
  append_number(text, std::round(value * 1e6) / 1e6 + 0.0);
  return text;
}

std::string rounded_text(const Vec3& v) {
  return '(' + rounded_text(v.x()) + ", " + rounded_text(v.y()) + ", " + rounded_text(v.z()) + ')';
}

/// Index of the coordinate axis that equals a vector; -1 for other vectors.
int axis_of(const Vec3& v) {
  for (const int axis : {0, 1, 2}) {
    if (v == Vec3::Unit(axis)) return axis;
  }
  return -1;
}

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

}  // namespace

std::optional<PlanePlacement> PlanePlacement::find(const std::vector<double>& xyz) {
  if (xyz.empty()) return std::nullopt;
  const PointMap points = points_of(xyz);
  const double tolerance = tolerance_of(points);
  // Use exact axes, so that in-plane coordinates equal those of the file.
  for (const int axis : {2, 1, 0}) {
    if (!constant_along(points, axis, tolerance)) continue;
    const Vec3 u = Vec3::Unit(axis == 0 ? 1 : 0), v = Vec3::Unit(axis == 2 ? 1 : 2);
    return PlanePlacement(xyz, u, v);
  }
  const FittedPlane plane(points);
  if (!(plane.distance <= tolerance)) return std::nullopt;
  const auto [u, v] = axes_of(plane.normal);
  return PlanePlacement(xyz, u, v);
}

double distance_from_plane(const std::vector<double>& xyz) {
  return FittedPlane(points_of(xyz)).distance;
}

Vec3 PlanePlacement::point(Index i) const { return points_of(xyz_).col(i); }

Vec2 PlanePlacement::in_plane(Index i) const {
  const Vec3 p = point(i);
  return {u_.dot(p), v_.dot(p)};
}

Vec3 PlanePlacement::in_space(Index i, const Vec2& p) const {
  const bool known = i < size();
  if (known && in_plane(i) == p) return point(i);
  const Vec3 n = normal();
  return n * n.dot(point(known ? i : 0)) + p.x() * u_ + p.y() * v_;
}

std::string PlanePlacement::axes_text() const {
  const int first = axis_of(u_), second = axis_of(v_);
  if (first >= 0 && second >= 0) {
    return std::string("(") + axis_names[static_cast<std::size_t>(first)] + ", " +
           axis_names[static_cast<std::size_t>(second)] + ')';
  }
  return "along " + rounded_text(u_) + " and " + rounded_text(v_);
}

std::string PlanePlacement::plane_text() const {
  const Vec3 n = normal();
  const int axis = axis_of(n.cwiseAbs());
  if (axis >= 0) {
    return std::string("the plane ") + axis_names[static_cast<std::size_t>(axis)] + " = " +
           rounded_text(point(0)[axis]);
  }
  std::string sum;
  for (const int k : {0, 1, 2}) {
    if (std::abs(n[k]) < 1e-12) continue;
    const std::string sign = n[k] < 0 ? (sum.empty() ? "-" : " - ") : (sum.empty() ? "" : " + ");
    sum += sign + rounded_text(std::abs(n[k])) + ' ' + axis_names[static_cast<std::size_t>(k)];
  }
  return "the plane " + sum + " = " + rounded_text(n.dot(point(0)));
}

namespace {

bool from_behind(const Mesh& mesh, const FormatDetails* details) {
  return mesh.coordinates.dimension() == 2 && details != nullptr && details->plane &&
         details->plane->from_behind;
}

/// z of a node in the source of the mesh (0 without details).
double plane_z(const FormatDetails* details, Index node) {
  if (details == nullptr || details->plane_z.empty()) return 0.0;
  const auto& z = details->plane_z;
  const auto i = static_cast<std::size_t>(node);
  return z.size() == 1 || i >= z.size() ? z.front() : z[i];
}

}  // namespace

Vec3 place_in_space(const FormatDetails* details, const Coordinates& x, Index node) {
  if (x.dimension() == 3) return x.xyz(node);
  const Vec2 p = x.xy(node);
  if (details != nullptr && details->plane) return details->plane->in_space(node, p);
  return {p.x(), p.y(), plane_z(details, node)};
}

int coordinates_in_file(const Mesh& mesh, const FormatDetails* details) {
  const bool elsewhere = details != nullptr && (details->plane || !details->plane_z.empty());
  return elsewhere ? 3 : mesh.coordinates.dimension();
}

Vec3 MeshInSpace::node(Index i) const { return place_in_space(details_, mesh_.coordinates, i); }

FileCorners MeshInSpace::element(Index e) const {
  FileCorners file(mesh_.topology->element(e));
  // Reversing keeps the first corner.
  if (from_behind(mesh_, details_)) std::ranges::reverse(file.span().subspan(1));
  return file;
}

Vec3 MeshInSpace::normal() const {
  if (details_ == nullptr || !details_->plane) return Vec3::UnitZ();
  const Vec3 n = details_->plane->normal();
  return details_->plane->from_behind ? Vec3(-n) : n;
}

}  // namespace winslow::io
