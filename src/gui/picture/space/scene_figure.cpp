#include "gui/picture/space/scene_figure.h"

#include <queue>
#include <unordered_set>

#include "gui/base/text.h"
#include "gui/render/draw_list.h"

namespace winslow::gui {

namespace {

constexpr double faintest = 0.03;  // of lines: fainter ones are left out

Rgb unpacked(std::uint32_t rgba) {
  const auto byte = [&](unsigned shift) {
    return static_cast<float>(rgba >> shift & 0xFFU) / 255.0f;
  };
  return {byte(0), byte(8), byte(16)};
}

/// Clips a convex polygon to the part behind a plane.
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

/// Converts a scene to polygons and lines, with the rules of the renderer.
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
    const bool piled = layers() > options_.most_layers;
    figure_.wants_raster = piled || !put_what_is_seen();
    // Every pixel of a pile is painted a thousand times.
    if (piled) figure_.raster_pixels = 1;
    if (options_.axes) add_axes();
    if (options_.scale_bar && !camera_.in_perspective()) add_scale_bar();
    return std::move(figure_);
  }

 private:
  /// Place on the page, with a z that is linear on screen.
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
    // Emphasised fills lie above others in the same place.
    const double lift = fill.emphasised ? 1e-5 * extent_ : 0;
    for (std::size_t first = 0; first + 2 < fill.corners.size(); first += 3) {
      std::vector<Vec3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners.push_back(part.place_of(fill.corners[first + k].position));
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

  /// How often the polygons cover the page, at most: each as its area, or as its box on the page.
  double layers() const {
    const ScreenVector size = camera_.viewport().size();
    double sum = 0;
    for (const SeenPolygon& polygon : polygons_) {
      double doubled = 0;
      ScreenVector low = size, high(0, 0);
      for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
        const Vec3 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.corners.size()];
        doubled += a.x() * b.y() - b.x() * a.y();
        const ScreenVector inside(std::clamp(a.x(), 0.0, size.x()),
                                  std::clamp(a.y(), 0.0, size.y()));
        low = ScreenVector(std::min(low.x(), inside.x()), std::min(low.y(), inside.y()));
        high = ScreenVector(std::max(high.x(), inside.x()), std::max(high.y(), inside.y()));
      }
      sum += std::min(0.5 * std::abs(doubled), (high.x() - low.x()) * (high.y() - low.y()));
    }
    return sum / (size.x() * size.y());
  }

  /// False if it is too much, and nothing is put.
  bool put_what_is_seen() {
    const ScreenVector size = camera_.viewport().size();
    const HiddenSurface hidden(size.x(), size.y(), polygons_);
    const std::vector<std::size_t> order = hidden.order();
    if (order.size() > options_.most_polygons) return false;
    for (const std::size_t k : order) put_polygon(k);
    for (const auto& part : parts_)
      for (const SpaceLines& lines : part->lines) add_lines(*part, lines, hidden);
    return true;
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
      std::vector<Vec3> ends{part.place_of(lines.ends[k].position),
                             part.place_of(lines.ends[k + 1].position)};
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

  /// Adds the directions of the axes, bottom left.
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

  /// Adds a bar of a round length, bottom right.
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

namespace {

constexpr double most_samples = 2400;  // along the longer side
constexpr double finest = 3;           // samples per point
constexpr float nothing = std::numeric_limits<float>::max();

double doubled_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double mean_depth(const SeenPolygon& polygon) {
  double sum = 0;
  for (const Vec3& corner : polygon.corners) sum += corner.z();
  return sum / static_cast<double>(polygon.corners.size());
}

/// Finds an order that draws covered polygons first. Polygons that cover each other, by round-off
/// or in a cycle, are ordered by depth.
class DrawOrder {
 public:
  explicit DrawOrder(std::span<const SeenPolygon> polygons)
      : polygons_(polygons), covered_by_(polygons.size()), covers_(polygons.size(), 0) {}

  void add(std::uint32_t behind, std::uint32_t before) {
    const std::uint64_t key = (std::uint64_t{behind} << 32U) | before;
    if (!known_.insert(key).second) return;
    covered_by_[behind].push_back(before);
    ++covers_[before];
  }

  std::vector<std::size_t> sorted(const std::vector<unsigned char>& seen) {
    using Entry = std::pair<double, std::size_t>;  // the farthest first
    std::priority_queue<Entry> ready;
    std::vector<Entry> all;
    for (std::size_t k = 0; k < polygons_.size(); ++k) {
      if (seen[k] == 0) continue;
      all.emplace_back(mean_depth(polygons_[k]), k);
      if (covers_[k] == 0) ready.push(all.back());
    }
    std::ranges::sort(all, std::greater<>());
    std::vector<unsigned char> done(polygons_.size(), 0);
    std::vector<std::size_t> order;
    for (std::size_t next = 0; order.size() < all.size();) {
      std::size_t k = 0;
      if (!ready.empty()) {
        k = ready.top().second;
        ready.pop();
      } else {
        while (done[all[next].second] != 0) ++next;
        k = all[next].second;
      }
      if (done[k] != 0) continue;
      done[k] = 1;
      order.push_back(k);
      for (const std::uint32_t other : covered_by_[k])
        if (--covers_[other] == 0) ready.emplace(mean_depth(polygons_[other]), other);
    }
    return order;
  }

 private:
  std::span<const SeenPolygon> polygons_;
  std::vector<std::vector<std::uint32_t>> covered_by_;
  std::vector<int> covers_;  // how many
  std::unordered_set<std::uint64_t> known_;
};

}  // namespace

HiddenSurface::HiddenSurface(double width, double height, std::span<const SeenPolygon> polygons)
    : polygons_(polygons) {
  grid_.per_point = std::min(finest, most_samples / std::max({width, height, 1.0}));
  grid_.columns = std::max(1, static_cast<int>(std::ceil(width * grid_.per_point)));
  grid_.rows = std::max(1, static_cast<int>(std::ceil(height * grid_.per_point)));
  depth_.assign(grid_.at(0, grid_.rows), nothing);
  for (const SeenPolygon& polygon : polygons_) {
    if (polygon.see_through) continue;
    for_samples(polygon,
                [&](std::size_t sample, float z) { depth_[sample] = std::min(depth_[sample], z); });
  }
  find_seen();
}

template <class Visit>
void HiddenSurface::for_samples(const SeenPolygon& polygon, const Visit& visit) const {
  const double s = grid_.per_point;
  for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k) {
    std::array<Vec3, 3> p{polygon.corners[0], polygon.corners[k], polygon.corners[k + 1]};
    if (doubled_area(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    const double whole = doubled_area(p[0], p[1], p[2]);
    if (!(whole > 0)) continue;
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const int first_x = std::max(0, static_cast<int>(std::ceil(left * s - 0.5)));
    const int last_x = std::min(grid_.columns - 1, static_cast<int>(std::floor(right * s - 0.5)));
    const int first_y = std::max(0, static_cast<int>(std::ceil(top * s - 0.5)));
    const int last_y = std::min(grid_.rows - 1, static_cast<int>(std::floor(bottom * s - 0.5)));
    for (int y = first_y; y <= last_y; ++y)
      for (int x = first_x; x <= last_x; ++x) {
        const Vec3 at((x + 0.5) / s, (y + 0.5) / s, 0);
        const double a = doubled_area(p[1], p[2], at), b = doubled_area(p[2], p[0], at);
        const double c = whole - a - b;
        if (a < 0 || b < 0 || c < 0) continue;
        visit(grid_.at(x, y),
              static_cast<float>((a * p[0].z() + b * p[1].z() + c * p[2].z()) / whole));
      }
  }
}

void HiddenSurface::find_seen() {
  seen_.assign(polygons_.size(), 0);
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    bool sampled = false;
    for_samples(polygons_[k], [&](std::size_t sample, float z) {
      sampled = true;
      if (z <= depth_[sample]) seen_[k] = 1;
    });
    if (!sampled && small_in_the_open(polygons_[k])) seen_[k] = 1;
  }
}

bool HiddenSurface::small_in_the_open(const SeenPolygon& polygon) const {
  // A polygon seen along its plane is invisible.
  constexpr double least = 0.01;  // square points
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k)
    twice += doubled_area(polygon.corners[0], polygon.corners[k], polygon.corners[k + 1]);
  if (std::abs(twice) < 2 * least) return false;
  Vec3 middle(0, 0, 0);
  for (const Vec3& corner : polygon.corners) middle += corner;
  middle /= static_cast<double>(polygon.corners.size());
  return static_cast<float>(middle.z()) <= depth_around(middle.x(), middle.y());
}

float HiddenSurface::depth_around(double x, double y) const {
  const int column = static_cast<int>(std::floor(x * grid_.per_point));
  const int row = static_cast<int>(std::floor(y * grid_.per_point));
  float farthest = std::numeric_limits<float>::lowest();
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = column - 1; c <= column + 1; ++c)
      if (r >= 0 && c >= 0 && r < grid_.rows && c < grid_.columns)
        farthest = std::max(farthest, depth_[grid_.at(c, r)]);
  return farthest == std::numeric_limits<float>::lowest() ? nothing : farthest;
}

std::vector<std::size_t> HiddenSurface::order() const {
  // For each sample, a list of the polygons over it; all lists share one array.
  struct Cover {
    float z;
    std::uint32_t polygon;
    std::uint32_t next;
  };
  constexpr std::uint32_t end = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> head(depth_.size(), end);
  std::vector<Cover> covers;
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    if (seen_[k] == 0) continue;
    for_samples(polygons_[k], [&](std::size_t sample, float z) {
      covers.push_back({z, static_cast<std::uint32_t>(k), head[sample]});
      head[sample] = static_cast<std::uint32_t>(covers.size() - 1);
    });
  }
  DrawOrder order(polygons_);
  std::vector<std::pair<float, std::uint32_t>> here;
  for (const std::uint32_t first : head) {
    here.clear();
    for (std::uint32_t k = first; k != end; k = covers[k].next)
      here.emplace_back(covers[k].z, covers[k].polygon);
    std::ranges::sort(here, std::greater<>());
    for (std::size_t k = 1; k < here.size(); ++k)
      if (here[k].second != here[k - 1].second) order.add(here[k - 1].second, here[k].second);
  }
  return order.sorted(seen_);
}

std::vector<std::array<double, 2>> HiddenSurface::seen_parts(const Vec3& a, const Vec3& b,
                                                             double slack) const {
  const double length = std::hypot(b.x() - a.x(), b.y() - a.y()) * grid_.per_point;
  const int pieces = std::clamp(static_cast<int>(std::ceil(length)), 1, 10000);
  std::vector<std::array<double, 2>> parts;
  for (int k = 0; k < pieces; ++k) {
    const double t = (k + 0.5) / pieces;
    const Vec3 p = a + t * (b - a);
    if (p.z() - slack > static_cast<double>(depth_around(p.x(), p.y()))) continue;
    const double from = static_cast<double>(k) / pieces, to = static_cast<double>(k + 1) / pieces;
    if (!parts.empty() && parts.back()[1] == from)
      parts.back()[1] = to;
    else
      parts.push_back({from, to});
  }
  return parts;
}

}  // namespace winslow::gui
