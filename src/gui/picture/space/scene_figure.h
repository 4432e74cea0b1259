#pragma once

#include "core/types.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/space/space_scene.h"
#include "gui/render/space/space_view.h"

namespace winslow::gui {

/// Options for the conversion of a scene to vector graphics.
struct SceneFigureOptions {
  double line_scale = 1;  ///< factor on the widths of the scene's lines
  bool axes = true, scale_bar = true;
  Rgb ink{0, 0, 0};  ///< of axes and scale bar
  double font_size = 10;
  /// A larger number is better drawn as pixels.
  std::size_t most_polygons = 60'000;
  /// How often the polygons may cover the page. A tangled mesh covers it some thousand times: to
  /// find what is seen of it would take minutes, and its faces cross each other, so that no order
  /// of drawing them is right.
  double most_layers = 20;
};

/// Converts what a camera sees of a scene, without hidden surfaces and lines. camera: its viewport,
/// in points, has its corner at 0. If there are too many polygons, or too many over one another,
/// the result has wants_raster set, and neither polygons nor lines.
FigureScene figure_of_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                            std::span<const Plane> planes, const SpaceCamera& camera,
                            const SceneFigureOptions& options);

/// Flat convex polygons on screen: x and y in points, z grows away from the viewer and is linear on
/// screen.
struct SeenPolygon {
  std::vector<Vec3> corners;
  bool see_through = false;  ///< hides nothing
};

/// Finds the visible ones of many polygons, and an order in which to draw them over one another.
/// They are sampled on a grid: a polygon that lies only between samples is lost, unless it is small
/// and nothing hides it.
class HiddenSurface {
 public:
  /// width, height: of the page, points.
  HiddenSurface(double width, double height, std::span<const SeenPolygon> polygons);

  /// The visible polygons; each comes before those that cover it.
  std::vector<std::size_t> order() const;

  /// The visible parts of a line, as shares of its length from a. slack: of z.
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
  /// The largest value of depth_ around a place.
  float depth_around(double x, double y) const;

  std::span<const SeenPolygon> polygons_;
  Grid grid_;
  std::vector<float> depth_;         // of the nearest solid polygon at each sample
  std::vector<unsigned char> seen_;  // per polygon
};

}  // namespace winslow::gui
