#pragma once

#include <utility>

#include "core/inspect/nodal_view.h"
#include "core/mesh/mesh.h"
#include "gui/base/screen.h"
#include "gui/picture/figure/page.h"
#include "gui/picture/frame/picture_frame.h"
#include "gui/render/image.h"

namespace winslow::gui {

struct FigurePolygon {
  std::vector<ScreenPoint> corners;  ///< points, from the corner of the mesh's part of the page
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

/// The visible parts of a scene in space as vector graphics, in drawing order: later items cover
/// earlier ones.
struct FigureScene {
  std::vector<FigurePolygon> polygons;
  std::vector<FigureLine> lines;
  /// Replaces polygons and lines if there are too many: pixels for the whole of the mesh's part.
  std::optional<Image> raster;
  bool wants_raster = false;      ///< there are too many polygons, or too many over one another
  double raster_pixels = 3;       ///< how many a point should have then
  std::vector<FigureLine> marks;  ///< axes and scale
  std::vector<FigureText> texts;
};

/// Draws a scene into the part of the page whose corner is `origin`, clipped to that part.
void draw_figure_scene(Page& page, const FigureScene& scene, const ScreenPoint& origin,
                       const ScreenVector& size, double font_size, const Rgb& ink);

/// A magnified part of the mesh, drawn over the mesh.
struct FigureInset {
  Camera camera;     ///< its viewport is the place of the inset, relative to that of the figure
  ScreenBox source;  ///< what it magnifies
};

/// The content of a figure: a mesh as vector graphics. Lengths are points, 1/72 of an inch, in
/// place of the pixels of the screen.
struct VectorFigure {
  /// The drawing of a mesh in space; replaces `mesh` and what belongs to it.
  std::shared_ptr<const FigureScene> scene;
  Mesh mesh;
  Camera camera;                 ///< its viewport is the place of the mesh, which is clipped to it
  std::vector<double> values;    ///< colour the elements, one each; none: plain
  std::optional<Legend> legend;  ///< right of the mesh, with the scale of the values
  std::optional<ColorScale> scale;               ///< of the values
  std::string title;                             ///< above the mesh; empty: none
  std::string warning;                           ///< below it, in red; empty: none
  std::string note;                              ///< beside it; empty: none
  std::vector<std::pair<std::string, Rgb>> key;  ///< names of markers in their colours, below it
  /// Colour of each marker of the mesh; none: the marker is not drawn.
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
/// A figure with the texts and the layout of a picture of that size, one point per pixel. The
/// caller adds the mesh.
VectorFigure begin_figure(const PictureText& text, bool dark, int width, int height);

/// Draws the mesh of a figure as a camera sees it into that camera's viewport, which is put at
/// `origin` on the page: elements in the colours of their values, inverted ones in red, edges, the
/// boundary in its markers' colours. Each edge is drawn once; edges of one kind form one path.
void draw_figure_mesh(Page& page, const VectorFigure& figure, const Camera& camera,
                      const ScreenPoint& origin);

/// Draws the VCVs of a figure over its mesh, shifted by `origin` on the page, as draw_vcvs() does
/// on screen.
void draw_figure_vcvs(Page& page, const VectorFigure& figure, const ScreenPoint& origin);

/// True for .svg and .pdf.
bool is_vector_format(const std::filesystem::path& path);
/// Throws UsageError for an extension other than .png, .svg and .pdf: the content would not match
/// it.
void check_picture_name(const std::filesystem::path& path);

/// Writes a figure as one page of SVG or PDF, by the ending of the file's name, fonts embedded. The
/// page is the camera's viewport with figure_margins() around it. Written to a temporary name and
/// renamed. Throws OutputError, UsageError for another ending.
void write_figure(const std::filesystem::path& path, const VectorFigure& figure);

}  // namespace winslow::gui
