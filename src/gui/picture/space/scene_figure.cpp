#include "gui/picture/space/scene_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "gui/picture/space/hidden_surface.h"
#include "gui/render/line_density.h"
#include "gui/render/ticks.h"

namespace winslow::gui {

namespace {

constexpr double faintest = 0.03;  // of lines: fainter ones are left out

Vec3 place(const std::array<float, 3>& p, const Vec3& origin) {
  return origin + Eigen::Vector3f(p.data()).cast<double>();
}

Rgb unpacked(std::uint32_t rgba) {
  const auto byte = [&](unsigned shift) {
    return static_cast<float>(rgba >> shift & 0xFFU) / 255.0f;
  };
  return {byte(0), byte(8), byte(16)};
}

/// What lies behind a plane of a convex polygon.
void cut_off(std::vector<Vec3>& polygon, const Plane& plane) {
  std::vector<Vec3> left;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double da = plane.distance(a), db = plane.distance(b);
    if (da <= 0) left.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) left.push_back(a + da / (da - db) * (b - a));
  }
  polygon = std::move(left);
}

/// Makes the polygons and lines of a scene as the graphics card does.
class SceneFigure {
 public:
  SceneFigure(std::span<const std::shared_ptr<const SpaceScene>> parts,
              std::span<const Plane> planes, const SpaceCamera& camera,
              const SceneFigureOptions& options)
      : parts_(parts), planes_(planes), camera_(camera), options_(options) {
    if (camera.in_perspective()) {
      distance_ = (camera.viewer() - camera.centre()).norm();
      near_.emplace(camera.viewer() - 1e-3 * distance_ * camera.back(), camera.back());
    }
    light_ = (camera.back() + 0.35 * camera.up() - 0.3 * camera.right()).normalized();
    for (const auto& part : parts) extent_ = std::max(extent_, part->extent.size().norm());
  }

  FigureScene make() {
    for (const auto& part : parts_)
      for (const SpaceFill& fill : part->fills) add_fill(*part, fill);
    const ScreenVector size = camera_.viewport().size();
    const HiddenSurface hidden(size.x(), size.y(), polygons_);
    const std::vector<std::size_t> order = hidden.order();
    figure_.wants_raster = order.size() > options_.most_polygons;
    if (!figure_.wants_raster) {
      for (const std::size_t k : order) put_polygon(k);
      for (const auto& part : parts_)
        for (const SpaceLines& lines : part->lines) add_lines(*part, lines, hidden);
    }
    if (options_.axes) add_axes();
    if (options_.scale_bar && !camera_.in_perspective()) add_scale_bar();
    return std::move(figure_);
  }

 private:
  /// z is linear on screen.
  Vec3 on_page(const Vec3& point) const {
    const auto [at, depth] = camera_.project(point);
    if (distance_ <= 0) return {at.x(), at.y(), depth};
    return {at.x(), at.y(), -distance_ * camera_.units_per_pixel() / camera_.pixel_size(point)};
  }

  void cut_by_planes(std::vector<Vec3>& polygon, unsigned clipped_by) const {
    for (std::size_t k = 0; k < planes_.size() && !polygon.empty(); ++k)
      if ((clipped_by >> k & 1U) != 0) cut_off(polygon, planes_[k]);
    if (near_ && !polygon.empty()) cut_off(polygon, *near_);
  }

  bool on_sheet(const std::vector<Vec3>& corners) const {
    const ScreenVector size = camera_.viewport().size();
    const auto all = [&](auto&& beyond) { return std::ranges::all_of(corners, beyond); };
    return !(all([](const Vec3& p) { return p.x() < 0; }) ||
             all([&](const Vec3& p) { return p.x() > size.x(); }) ||
             all([](const Vec3& p) { return p.y() < 0; }) ||
             all([&](const Vec3& p) { return p.y() > size.y(); }));
  }

  void add_fill(const SpaceScene& part, const SpaceFill& fill) {
    // What is emphasised lies above what is in the same place.
    const double lift = fill.emphasised ? 1e-5 * extent_ : 0;
    for (std::size_t first = 0; first + 2 < fill.corners.size(); first += 3) {
      std::vector<Vec3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners.push_back(place(fill.corners[first + k].position, part.origin));
      cut_by_planes(corners, fill.clipped_by);
      if (corners.size() < 3) continue;
      for (Vec3& corner : corners) {
        corner = on_page(corner);
        corner.z() -= lift;
      }
      if (!on_sheet(corners)) continue;
      const Eigen::Vector3f normal(fill.corners[first].normal.data());
      const auto lit = static_cast<float>(0.5 + 0.5 * std::abs(normal.cast<double>().dot(light_)));
      Rgb color = unpacked(fill.corners[first].rgba);
      for (float& c : color) c *= 1 + fill.shading * (lit - 1);
      polygons_.push_back({std::move(corners), fill.opacity < 1});
      colors_.push_back(color);
      alphas_.push_back(static_cast<double>(fill.opacity));
    }
  }

  void put_polygon(std::size_t k) {
    FigurePolygon& polygon = figure_.polygons.emplace_back();
    for (const Vec3& corner : polygons_[k].corners)
      polygon.corners.emplace_back(corner.x(), corner.y());
    polygon.color = colors_[k];
    polygon.alpha = alphas_[k];
  }

  void add_lines(const SpaceScene& part, const SpaceLines& lines, const HiddenSurface& hidden) {
    const double width = static_cast<double>(lines.width) * options_.line_scale;
    const double slack = 2e-4 * extent_;
    for (std::size_t k = 0; k + 1 < lines.ends.size(); k += 2) {
      std::vector<Vec3> ends{place(lines.ends[k].position, part.origin),
                             place(lines.ends[k + 1].position, part.origin)};
      const double pixel = camera_.pixel_size(0.5 * (ends[0] + ends[1]));
      const auto spacing = static_cast<double>(lines.ends[k].spacing);
      double alpha = static_cast<double>(lines.color[3]);
      if (spacing > 0) alpha *= line_opacity(spacing / pixel, width);
      if (alpha < faintest) continue;
      cut_by_planes(ends, lines.clipped_by);
      if (ends.size() < 2) continue;
      const std::vector<Vec3> seen{on_page(ends.front()), on_page(ends[1])};
      if (!on_sheet(seen)) continue;
      for (const auto& [from, to] : hidden.seen_parts(seen[0], seen[1], slack)) {
        const Vec3 a = seen[0] + from * (seen[1] - seen[0]), b = seen[0] + to * (seen[1] - seen[0]);
        figure_.lines.push_back({{a.x(), a.y()},
                                 {b.x(), b.y()},
                                 {lines.color[0], lines.color[1], lines.color[2]},
                                 alpha,
                                 width});
      }
    }
  }

  void add_mark(const ScreenPoint& a, const ScreenPoint& b) {
    figure_.marks.push_back({a, b, options_.ink, 1, 0.1 * options_.font_size});
  }

  /// Where the axes point, bottom left.
  void add_axes() {
    const double em = options_.font_size;
    const ScreenPoint origin(3 * em, camera_.viewport().size().y() - 3 * em);
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    for (Index k = 0; k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(k);
      const ScreenVector along(camera_.right().dot(axis), -camera_.up().dot(axis));
      const double length = along.norm();
      if (length < 0.08) {  // towards the viewer, or away
        figure_.texts.push_back({origin + ScreenVector(-0.8 * em, 0.8 * em), names[at(k)]});
        continue;
      }
      const ScreenPoint tip = origin + 2 * em * along;
      const ScreenVector unit = along / length, across(-unit.y(), unit.x());
      add_mark(origin, tip);
      for (const double side : {-1.0, 1.0})
        add_mark(tip, tip - 0.4 * em * unit + side * 0.16 * em * across);
      figure_.texts.push_back({tip + 0.65 * em * unit, names[at(k)]});
    }
  }

  /// A bar of a round length, bottom right.
  void add_scale_bar() {
    const ScreenVector size = camera_.viewport().size();
    const double em = options_.font_size;
    const std::vector<double> lengths =
        nice_ticks(0, std::min(0.2 * size.x(), 9 * em) * camera_.units_per_pixel(), 2);
    if (lengths.size() < 2) return;
    const ScreenPoint end(size.x() - em, size.y() - em);
    const ScreenPoint start = end - ScreenVector(lengths.back() / camera_.units_per_pixel(), 0);
    const ScreenVector tick(0, 0.3 * em);
    add_mark(start, end);
    add_mark(start - tick, start + tick);
    add_mark(end - tick, end + tick);
    figure_.texts.push_back(
        {midpoint(start, end) - ScreenVector(0, 0.85 * em), format_power(lengths.back())});
  }

  std::span<const std::shared_ptr<const SpaceScene>> parts_;
  std::span<const Plane> planes_;
  const SpaceCamera& camera_;
  const SceneFigureOptions& options_;
  double distance_ = 0;  // of the viewer; 0: parallel
  double extent_ = 0;
  std::optional<Plane> near_;
  Vec3 light_{0, 0, 1};
  std::vector<SeenPolygon> polygons_;
  std::vector<Rgb> colors_;
  std::vector<double> alphas_;
  FigureScene figure_;
};

}  // namespace

FigureScene figure_of_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                            std::span<const Plane> planes, const SpaceCamera& camera,
                            const SceneFigureOptions& options) {
  return SceneFigure(parts, planes, camera, options).make();
}

}  // namespace winslow::gui
