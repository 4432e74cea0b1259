#pragma once

#include <utility>

#include "core/inspect/nodal_view.h"
#include "core/mesh/mesh.h"
#include "gui/base/screen.h"
#include "gui/picture/figure/page.h"
#include "gui/render/image.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/view.h"
#include "gui/widgets/legend.h"

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

/// A place of the mesh drawn larger, over a part of it.
struct FigureInset {
  Camera camera;     ///< its viewport is where the inset goes, as the figure's
  ScreenBox source;  ///< what it magnifies
};

/// A mesh as vector graphics: what is drawn. Lengths are points, 1/72 of an inch, which stand for
/// the pixels of the screen.
struct VectorFigure {
  /// What is drawn of a volume mesh, in place of `mesh` and what belongs to it.
  std::shared_ptr<const FigureScene> scene;
  Mesh mesh;
  Camera camera;  ///< its viewport is where the mesh goes; what lies outside is cut off
  std::vector<double> values;       ///< colour the elements, one each; none: plain
  std::optional<Legend> legend;     ///< right of the mesh; its scale is that of the values
  std::optional<ColorScale> scale;  ///< of the values
  std::string title;                ///< above the mesh; empty: none
  std::string warning;              ///< below it, in red; empty: none
  std::string note;                 ///< beside it; empty: none
  std::vector<std::pair<std::string, Rgb>> key;  ///< names of markers in their colours, below it
  /// Of each marker of the mesh; none: it is not drawn.
  std::vector<std::optional<Rgb>> marker_colors;
  std::vector<NodalView> vcvs;  ///< drawn over the mesh
  std::optional<FigureInset> inset;
  bool fill = true;
  bool wireframe = true;
  bool mark_inverted = true;
  bool dark = false;
  bool framed = false;  ///< a thin line around the mesh's part of the page
  double edge_width = 0.5, boundary_width = 1.4;
  double font_size = 10;
};

/// Room on the page around the mesh, in points.
struct FigureMargins {
  double left = 0, top = 0, right = 0, bottom = 0;
};
FigureMargins figure_margins(const VectorFigure& figure);

}  // namespace winslow::gui
