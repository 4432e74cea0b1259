#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gui/base/screen.h"
#include "gui/picture/figure/page.h"
#include "gui/render/image.h"

namespace winslow::gui {

struct FigurePolygon {
  std::vector<ScreenPoint> corners;  ///< points of the page, from the corner of the mesh's part
  Rgb color{1, 1, 1};
  double alpha = 1;
};
struct FigureLine {
  ScreenPoint a, b;
  Rgb color{0, 0, 0};
  double alpha = 1, width = 1;
};
struct FigureText {
  ScreenPoint centre;
  std::string text;
};

/// What is to be seen in space as vector graphics: what is hidden is left out, and what comes later
/// covers what came before.
struct FigureScene {
  std::vector<FigurePolygon> polygons;
  std::vector<FigureLine> lines;
  /// In place of both where there is too much to be seen: pixels for the whole of the mesh's part.
  std::optional<Image> raster;
  bool wants_raster = false;      ///< there is too much to be seen
  std::vector<FigureLine> marks;  ///< axes and scale
  std::vector<FigureText> texts;
};

/// Into a part of the page, whose corner is `origin`; what lies outside is cut off.
void draw_figure_scene(Page& page, const FigureScene& scene, const ScreenPoint& origin,
                       const ScreenVector& size, double font_size, const Rgb& ink);

}  // namespace winslow::gui
