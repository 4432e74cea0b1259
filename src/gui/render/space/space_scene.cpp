#include "gui/render/space/space_scene.h"

namespace winslow::gui {

namespace {

using Vec3f = Eigen::Vector3f;

Vec3f place_of(const SpaceCorner& corner) { return Vec3f(corner.position.data()); }

/// Parameter of a ray at its intersection with a triangle (T. Moeller and B. Trumbore, Journal of
/// Graphics Tools 2, 1997); NaN if there is none.
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
    // The ray starts near the middle of the mesh, so that single precision suffices there.
    const double shift = along.dot(part->origin - ray.origin);
    const Vec3 start = ray.origin + shift * along;
    const Vec3f from = (start - part->origin).cast<float>(), direction = along.cast<float>();
    for (const SpaceFill& fill : part->fills) {
      if (fill.opacity < 1) continue;
      for (std::size_t k = 0; k + 2 < fill.corners.size(); k += 3) {
        const double t = shift + crossing(&fill.corners[k], from, direction);
        if (!(t >= 0 && t < nearest)) continue;
        const Vec3 point = ray.origin + t * along;
        if (cut_away(point, fill.clipped_by, planes)) continue;
        nearest = t;
        const Vec3f normal(fill.corners[k].normal.data());
        best = SpaceHit{point, normal.cast<double>(), fill.elements[k / 3], fill.marker};
      }
    }
  }
  if (best && best->normal.dot(along) > 0) best->normal = -best->normal;
  return best;
}

namespace {

/// A grid of places on the screen, to find those in a triangle.
class PlaceGrid {
 public:
  explicit PlaceGrid(const ScreenBox& box) : box_(box) {
    columns_ = std::max(1, static_cast<int>(box.size().x() / side) + 1);
    rows_ = std::max(1, static_cast<int>(box.size().y() / side) + 1);
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }
  void add(const ScreenPoint& at, std::size_t label) {
    cells_[cell(column(at), row(at))].push_back(label);
  }

  template <class Visit>
  void around(const SeenTriangle& triangle, const Visit& visit) const {
    ScreenPoint low = triangle.seen[0].at, high = low;
    for (const auto& p : triangle.seen) {
      low = {std::min(low.x(), p.at.x()), std::min(low.y(), p.at.y())};
      high = {std::max(high.x(), p.at.x()), std::max(high.y(), p.at.y())};
    }
    for (int y = row(low); y <= row(high); ++y)
      for (int x = column(low); x <= column(high); ++x)
        for (const std::size_t label : cells_[cell(x, y)]) visit(label);
  }

 private:
  static constexpr double side = 32;  // pixels
  int column(const ScreenPoint& p) const {
    return static_cast<int>(std::clamp((p.x() - box_.min.x()) / side, 0.0, columns_ - 1.0));
  }
  int row(const ScreenPoint& p) const {
    return static_cast<int>(std::clamp((p.y() - box_.min.y()) / side, 0.0, rows_ - 1.0));
  }
  std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }

  ScreenBox box_;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

bool cut_away(const Vec3& point, unsigned by, std::span<const Plane> planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((by >> k & 1U) != 0 && planes[k].distance(point) > 0) return true;
  return false;
}

double SeenTriangle::area() const { return 0.5 * std::abs(side(0).cross(seen[2].at - seen[0].at)); }

std::array<double, 3> SeenTriangle::weights(const ScreenPoint& p) const {
  const double whole = side(0).cross(seen[2].at - seen[0].at);
  const double a = (seen[1].at - p).cross(seen[2].at - p) / whole;
  const double b = (seen[2].at - p).cross(seen[0].at - p) / whole;
  return {a, b, 1 - a - b};
}

void hide_behind(const View& view, std::span<const std::shared_ptr<const SpaceScene>> parts,
                 std::span<const Plane> planes, std::span<DeepPlace> places) {
  if (parts.empty()) return;
  PlaceGrid grid(view.viewport());
  for (std::size_t k = 0; k < places.size(); ++k) grid.add(places[k].at, k);
  const double slack = 1e-4 * parts.front()->extent.size().norm();
  for (const auto& part : parts)
    for (const SpaceFill& fill : part->fills) {
      if (fill.opacity < 1) continue;
      for (std::size_t first = 0; first + 2 < fill.corners.size(); first += 3) {
        const SeenTriangle triangle(fill, first, *part, view);
        if (!triangle.near(view.viewport()) || !(triangle.area() > 0)) continue;
        grid.around(triangle, [&](std::size_t k) {
          DeepPlace& place = places[k];
          const auto w = triangle.weights(place.at);
          if (place.hidden || std::ranges::any_of(w, [](double v) { return v < 0; })) return;
          double depth = 0;
          Vec3 point(0, 0, 0);
          for (std::size_t c = 0; c < 3; ++c) {
            depth += w[c] * triangle.seen[c].depth;
            point += w[c] * triangle.at[c];
          }
          if (depth < place.depth - slack && !cut_away(point, fill.clipped_by, planes))
            place.hidden = true;
        });
      }
    }
}

}  // namespace winslow::gui
