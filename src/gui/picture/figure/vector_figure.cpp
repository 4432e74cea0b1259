#include "gui/picture/figure/vector_figure.h"

namespace winslow::gui {

namespace {

/// Between neighbours of one colour no ground is to shine through, points.
constexpr double rim_width = 0.25;

void draw_line(Page& page, const FigureLine& line, const ScreenPoint& origin) {
  page.set_color(line.color, line.alpha);
  page.set_line(line.width, true);
  page.move_to(origin.x() + line.a.x(), origin.y() + line.a.y());
  page.line_to(origin.x() + line.b.x(), origin.y() + line.b.y());
  page.stroke();
}

}  // namespace

void draw_figure_scene(Page& page, const FigureScene& scene, const ScreenPoint& origin,
                       const ScreenVector& size, double font_size, const Rgb& ink) {
  page.clip(origin.x(), origin.y(), size.x(), size.y());
  if (scene.raster) page.image(*scene.raster, {origin.x(), origin.y(), size.x(), size.y()});
  for (const FigurePolygon& polygon : scene.polygons) {
    page.set_color(polygon.color, polygon.alpha);
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const double x = origin.x() + polygon.corners[k].x();
      const double y = origin.y() + polygon.corners[k].y();
      k == 0 ? page.move_to(x, y) : page.line_to(x, y);
    }
    page.close_path();
    polygon.alpha < 1 ? page.fill() : page.fill_with_rim(rim_width);
  }
  for (const FigureLine& line : scene.lines) draw_line(page, line, origin);
  for (const FigureLine& mark : scene.marks) draw_line(page, mark, origin);
  page.unclip();
  for (const FigureText& text : scene.texts) {
    page.set_color(ink);
    const double width = page.text_width(text.text, font_size, FontWeight::regular);
    page.text(origin.x() + text.centre.x() - width / 2, origin.y() + text.centre.y(), text.text,
              font_size, FontWeight::regular);
  }
}

}  // namespace winslow::gui
