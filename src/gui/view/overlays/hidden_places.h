#pragma once

#include "gui/render/view.h"
#include "gui/view/mesh/volume_view.h"

namespace winslow::gui {

/// A point of a volume mesh on screen.
struct DeepPlace {
  ScreenPoint at;
  double depth = 0;
  bool hidden = false;
};
/// Marks places that a triangle of the picture hides: one over the place that lies nearer to the
/// viewer and is neither see-through nor cut away.
void hide_behind(const View& view, const VolumeScenes& scenes, std::span<DeepPlace> places);

/// Some of these planes (those whose bits are set in `by`) take the point away.
bool cut_away(const Vec3& point, unsigned by, const std::vector<Plane>& planes);

/// A triangle of a fill on screen.
struct SeenTriangle {
  std::array<Vec3, 3> at;
  std::array<View::Projection, 3> seen;

  SeenTriangle(const SpaceFill& fill, std::size_t first, const Vec3& origin, const View& view) {
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = origin + Eigen::Vector3f(fill.corners[first + k].position.data()).cast<double>();
      seen[k] = view.project(at[k]);
    }
  }
  ScreenVector side(std::size_t k) const { return seen[(k + 1) % 3].at - seen[k].at; }
  double area() const;
  double girth() const { return side(0).norm() + side(1).norm() + side(2).norm(); }
  bool near(const ScreenBox& box) const {
    const auto out = [&](auto&& beyond) { return std::ranges::all_of(seen, beyond); };
    return !(out([&](const auto& p) { return p.at.x() < box.min.x(); }) ||
             out([&](const auto& p) { return p.at.x() > box.max.x(); }) ||
             out([&](const auto& p) { return p.at.y() < box.min.y(); }) ||
             out([&](const auto& p) { return p.at.y() > box.max.y(); }));
  }
  /// Weights of the corners at a place; negative ones outside.
  std::array<double, 3> weights(const ScreenPoint& p) const;
};

}  // namespace winslow::gui
