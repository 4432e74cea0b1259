#include "gui/picture/space/hidden_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_set>
#include <utility>

namespace winslow::gui {

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

/// Draws first what is covered. What covers each other, by round-off or in a ring, goes by depth.
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
  // Seen along its plane there is nothing of it to be seen.
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
  // Of each sample the polygons over it, as a list through one array.
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
