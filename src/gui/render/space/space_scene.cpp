#include "gui/render/space/space_scene.h"

namespace winslow::gui {

namespace {

using Vec3f = Eigen::Vector3f;

Vec3f place_of(const SpaceCorner& corner) { return Vec3f(corner.position.data()); }

bool clipped(const Vec3& point, unsigned by, std::span<const Plane> planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((by >> k & 1U) != 0 && planes[k].distance(point) > 0) return true;
  return false;
}

/// Where along the ray it goes through a triangle (T. Moeller and B. Trumbore, Journal of Graphics
/// Tools 2, 1997); not a number if it does not.
double crossing(const SpaceCorner* corners, const Vec3f& from, const Vec3f& along) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Vec3f a = place_of(corners[0]);
  const Vec3f u = place_of(corners[1]) - a, v = place_of(corners[2]) - a;
  const Vec3f p = along.cross(v);
  const float determinant = u.dot(p);
  if (determinant == 0) return none;
  const Vec3f s = from - a;
  const float x = s.dot(p) / determinant;
  if (!(x >= 0 && x <= 1)) return none;
  const Vec3f q = s.cross(u);
  const float y = along.dot(q) / determinant;
  if (!(y >= 0 && x + y <= 1)) return none;
  return static_cast<double>(v.dot(q) / determinant);
}

}  // namespace

std::optional<SpaceHit> pick_in_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                                      std::span<const Plane> planes, const Ray<3>& ray) {
  std::optional<SpaceHit> best;
  double nearest = std::numeric_limits<double>::infinity();
  const Vec3 along = ray.direction.normalized();
  for (const auto& part : parts) {
    // From the middle of the mesh, so that what is near it keeps its digits.
    const double shift = along.dot(part->origin - ray.origin);
    const Vec3 start = ray.origin + shift * along;
    const Vec3f from = (start - part->origin).cast<float>(), direction = along.cast<float>();
    for (const SpaceFill& fill : part->fills) {
      if (fill.opacity < 1) continue;
      for (std::size_t k = 0; k + 2 < fill.corners.size(); k += 3) {
        const double t = shift + crossing(&fill.corners[k], from, direction);
        if (!(t >= 0 && t < nearest)) continue;
        const Vec3 point = ray.origin + t * along;
        if (clipped(point, fill.clipped_by, planes)) continue;
        nearest = t;
        const Vec3f normal(fill.corners[k].normal.data());
        best = SpaceHit{point, normal.cast<double>(), fill.elements[k / 3], fill.marker};
      }
    }
  }
  if (best && best->normal.dot(along) > 0) best->normal = -best->normal;
  return best;
}

}  // namespace winslow::gui
