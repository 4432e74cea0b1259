#pragma once

#include "core/types.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/space/space_scene.h"
#include "gui/render/space/space_view.h"

namespace winslow::gui {

/// How a scene becomes vector graphics.
struct SceneFigureOptions {
  double line_scale = 1;  ///< widths of the scene's lines are times this
  bool axes = true, scale_bar = true;
  Rgb ink{0, 0, 0};  ///< of these
  double font_size = 10;
  /// More than that are better drawn as pixels.
  std::size_t most_polygons = 60'000;
};

/// What a camera sees of the parts of a scene, hidden surfaces and lines left out. camera: its
/// viewport, in points, has its corner at 0. Of too many polygons none, and no lines: it then
/// wants a raster.
FigureScene figure_of_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                            std::span<const Plane> planes, const SpaceCamera& camera,
                            const SceneFigureOptions& options);

/// Flat convex polygons on screen: x and y in points, z grows away from the viewer and is linear on
/// screen.
struct SeenPolygon {
  std::vector<Vec3> corners;
  bool see_through = false;  ///< hides nothing
};

/// Which of many polygons are seen, and in which order they can be drawn one over the other. They
/// are sampled on a grid: what lies between samples alone is lost, unless it is small and in the
/// open.
class HiddenSurface {
 public:
  /// Of a page of that size, points.
  HiddenSurface(double width, double height, std::span<const SeenPolygon> polygons);

  /// Polygons that are seen, those that others cover before those others.
  std::vector<std::size_t> order() const;

  /// Parts of a line that nothing hides, as shares of its length from a; slack: of z.
  std::vector<std::array<double, 2>> seen_parts(const Vec3& a, const Vec3& b, double slack) const;

 private:
  struct Grid {
    int columns = 1, rows = 1;
    double per_point = 1;  // samples
    std::size_t at(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(x);
    }
  };
  template <class Visit>
  void for_samples(const SeenPolygon& polygon, const Visit& visit) const;
  void find_seen();
  bool small_in_the_open(const SeenPolygon& polygon) const;
  /// The farthest of what is nearest around a place.
  float depth_around(double x, double y) const;

  std::span<const SeenPolygon> polygons_;
  Grid grid_;
  std::vector<float> depth_;         // of the nearest solid polygon at each sample
  std::vector<unsigned char> seen_;  // per polygon
};

}  // namespace winslow::gui
