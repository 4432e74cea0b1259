#include "gui/view/overlays/hidden_places.h"

namespace winslow::gui {

namespace {

double doubled_area(const ScreenVector& a, const ScreenVector& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Places of the screen in a grid, to find those in a triangle.
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

bool cut_away(const Vec3& point, unsigned by, const std::vector<Plane>& planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((by >> k & 1U) != 0 && planes[k].distance(point) > 0) return true;
  return false;
}

double SeenTriangle::area() const {
  return 0.5 * std::abs(doubled_area(side(0), seen[2].at - seen[0].at));
}

std::array<double, 3> SeenTriangle::weights(const ScreenPoint& p) const {
  const double whole = doubled_area(side(0), seen[2].at - seen[0].at);
  const double a = doubled_area(seen[1].at - p, seen[2].at - p) / whole;
  const double b = doubled_area(seen[2].at - p, seen[0].at - p) / whole;
  return {a, b, 1 - a - b};
}

void hide_behind(const View& view, const VolumeScenes& scenes, std::span<DeepPlace> places) {
  if (scenes.parts.empty()) return;
  PlaceGrid grid(view.viewport());
  for (std::size_t k = 0; k < places.size(); ++k) grid.add(places[k].at, k);
  const double slack = 1e-4 * scenes.parts.front()->extent.size().norm();
  for (const auto& part : scenes.parts)
    for (const SpaceFill& fill : part->fills) {
      if (fill.opacity < 1) continue;
      for (std::size_t first = 0; first + 2 < fill.corners.size(); first += 3) {
        const SeenTriangle triangle(fill, first, part->origin, view);
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
          if (depth < place.depth - slack && !cut_away(point, fill.clipped_by, scenes.planes))
            place.hidden = true;
        });
      }
    }
}

}  // namespace winslow::gui
