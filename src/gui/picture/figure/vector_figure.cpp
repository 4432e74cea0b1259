#include "gui/picture/figure/vector_figure.h"

#include "gui/picture/frame/picture_frame.h"
#include "gui/render/draw_list.h"
#include "gui/view/overlays/vcv_overlay.h"

namespace winslow::gui {

namespace {

/// Width of the rim that closes gaps between neighbours of one colour, points.
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

namespace {

/// Room around the viewport into which lines extend, so that their cut ends are out of sight.
constexpr double cell_margin = 8;
/// Shades in which edges fade where they are dense.
constexpr int shades = 6;
/// Number of colours of a continuous scale: more than the eye distinguishes, but few paths.
constexpr int most_colors = 64;
constexpr double rim = 0.3;

/// Draws in a camera's viewport, placed at `origin` on a page.
class PlaneDrawing {
 protected:
  PlaneDrawing(Page& page, const VectorFigure& figure, const Camera& camera,
               const ScreenPoint& origin)
      : page_(page),
        figure_(figure),
        camera_(camera),
        area_{origin, origin + ScreenVector(camera.viewport_width(), camera.viewport_height())},
        box_{area_.min - ScreenVector(cell_margin, cell_margin),
             area_.max + ScreenVector(cell_margin, cell_margin)},
        shift_(origin - camera.viewport_origin()) {}

  ScreenPoint at(const Vec2& world) const { return camera_.to_screen(world) + shift_; }

  void add_polygon(std::vector<ScreenPoint> polygon) {
    bool inside = true;
    for (const ScreenPoint& p : polygon)
      inside = inside && p.x() >= box_.min.x() && p.y() >= box_.min.y() && p.x() <= box_.max.x() &&
               p.y() <= box_.max.y();
    if (!inside) polygon = clip_polygon(std::move(polygon), box_);
    if (polygon.size() < 3) return;
    page_.move_to(polygon[0].x(), polygon[0].y());
    for (std::size_t k = 1; k < polygon.size(); ++k) page_.line_to(polygon[k].x(), polygon[k].y());
    page_.close_path();
  }

  void add_line(const ScreenPoint& a, const ScreenPoint& b) {
    const auto line = clip_line(a, b, box_);
    if (!line) return;
    page_.move_to((*line)[0].x(), (*line)[0].y());
    page_.line_to((*line)[1].x(), (*line)[1].y());
  }

  Page& page_;
  const VectorFigure& figure_;
  const Camera& camera_;
  ScreenBox area_, box_;  // of the page; with room around it
  ScreenVector shift_;    // from the screen to the page
};

class MeshDrawing : PlaneDrawing {
 public:
  MeshDrawing(Page& page, const VectorFigure& figure, const Camera& camera,
              const ScreenPoint& origin)
      : PlaneDrawing(page, figure, camera, origin), theme_(picture_theme(figure.dark)) {}

  void draw() {
    const ScreenVector size = area_.size();
    page_.clip(area_.min.x(), area_.min.y(), size.x(), size.y());
    if (figure_.fill) draw_elements();
    const EdgeGroups groups = group_edges(topology());
    if (figure_.wireframe) draw_interior(groups.interior);
    draw_boundary(groups.unmarked_boundary);
    page_.unclip();
  }

 private:
  const Topology& topology() const { return *figure_.mesh.topology; }
  ScreenPoint at(Index node) const { return PlaneDrawing::at(figure_.mesh.coordinates.xy(node)); }

  void add_element(Index e) {
    const auto corners = topology().element(e);
    const Coordinates& x = figure_.mesh.coordinates;
    if (corners.size() == 3 || !shows_inverted(topology(), x, e)) {
      std::vector<ScreenPoint> polygon;
      for (const Index node : corners) polygon.push_back(at(node));
      // Clipping makes one polygon of a simple one: its parts outside lie on the rim.
      return add_polygon(std::move(polygon));
    }
    std::vector<std::array<Index, 3>> triangles;
    cut_element(topology(), x, e, triangles);
    for (const auto& [a, b, c] : triangles)
      add_polygon({at(corners[static_cast<std::size_t>(a)]),
                   at(corners[static_cast<std::size_t>(b)]),
                   at(corners[static_cast<std::size_t>(c)])});
  }

  bool seen(Index e) const {
    ScreenBox box{at(topology().element(e)[0]), at(topology().element(e)[0])};
    for (const Index node : topology().element(e)) {
      const ScreenPoint p = at(node);
      box.min = {std::min(box.min.x(), p.x()), std::min(box.min.y(), p.y())};
      box.max = {std::max(box.max.x(), p.x()), std::max(box.max.y(), p.y())};
    }
    return box.max.x() >= area_.min.x() && box.max.y() >= area_.min.y() &&
           box.min.x() <= area_.max.x() && box.min.y() <= area_.max.y();
  }

  /// Colour in the middle of its part of the scale, so that equal colours form one path.
  Rgb color_of(Index e) const {
    if (figure_.values.empty() || !figure_.scale) return rgb(theme_.fill);
    ColorScale scale = *figure_.scale;
    if (scale.bands == 0) scale.bands = most_colors;
    return scale.color(figure_.values[static_cast<std::size_t>(e)]);
  }

  void draw_elements() {
    std::map<Rgb, std::vector<Index>> by_color;
    std::vector<Index> inverted;
    for (Index e = 0; e < topology().element_count(); ++e) {
      if (!seen(e)) continue;
      if (figure_.mark_inverted && shows_inverted(topology(), figure_.mesh.coordinates, e))
        inverted.push_back(e);
      else
        by_color[color_of(e)].push_back(e);
    }
    const Rgb red = rgb(MeshStyle{}.inverted_color);
    if (!inverted.empty()) {
      // Above the others, as on screen.
      draw_colors(by_color);
      by_color = {{red, inverted}};
    }
    draw_colors(by_color);
  }

  void draw_colors(const std::map<Rgb, std::vector<Index>>& by_color) {
    for (const auto& [color, elements] : by_color) {
      page_.set_color(color);
      for (const Index e : elements) add_element(e);
      page_.fill_with_rim(rim);
    }
  }

  void draw_interior(const std::vector<Index>& edges) {
    std::array<std::vector<Index>, shades + 1> by_shade;
    for (const Index k : edges) {
      const auto& edge = topology().edges()[static_cast<std::size_t>(k)];
      if (!clip_line(at(edge.nodes[0]), at(edge.nodes[1]), area_)) continue;
      const double spacing =
          edge_spacing(topology(), figure_.mesh.coordinates, edge) / camera_.units_per_pixel();
      const double opacity = line_opacity(spacing, figure_.edge_width);
      by_shade[static_cast<std::size_t>(std::lround(opacity * shades))].push_back(k);
    }
    // On colours, dark lines are legible with any background.
    const bool colored = !figure_.values.empty();
    const Rgba& ink = colored ? picture_theme(false).edge : theme_.edge;
    for (int shade = 1; shade <= shades; ++shade) {
      const auto& lines = by_shade[static_cast<std::size_t>(shade)];
      if (lines.empty()) continue;
      page_.set_color(rgb(ink), (colored ? 0.6 : 1.0) * shade / shades);
      page_.set_line(figure_.edge_width, false);
      for (const Index k : lines) {
        const auto& edge = topology().edges()[static_cast<std::size_t>(k)];
        add_line(at(edge.nodes[0]), at(edge.nodes[1]));
      }
      page_.stroke();
    }
  }

  void draw_boundary(const std::vector<Index>& unmarked) {
    page_.set_line(figure_.boundary_width, true);
    if (!unmarked.empty()) {
      page_.set_color(rgb(theme_.edge));
      for (const Index k : unmarked) {
        const auto& edge = topology().edges()[static_cast<std::size_t>(k)];
        add_boundary_line(edge.nodes[0], edge.nodes[1]);
      }
      page_.stroke();
    }
    for (std::size_t m = 0; m < topology().markers().size(); ++m) {
      const bool known = m < figure_.marker_colors.size();
      if (known && !figure_.marker_colors[m]) continue;
      page_.set_color(known ? *figure_.marker_colors[m] : rgb(theme_.edge));
      for (const Face& edge : topology().markers()[m].faces) add_boundary_line(edge[0], edge[1]);
      page_.stroke();
    }
  }

  void add_boundary_line(Index a, Index b) {
    if (clip_line(at(a), at(b), area_)) add_line(at(a), at(b));
  }

  const PictureTheme& theme_;
};

}  // namespace

void draw_figure_mesh(Page& page, const VectorFigure& figure, const Camera& camera,
                      const ScreenPoint& origin) {
  MeshDrawing(page, figure, camera, origin).draw();
}

namespace {

class VcvDrawing : PlaneDrawing {
 public:
  VcvDrawing(Page& page, const VectorFigure& figure, const ScreenPoint& origin)
      : PlaneDrawing(page, figure, figure.camera, origin), unit_(0.06 * figure.font_size) {}

  void draw(const NodalView& node) {
    centre_ = at(node.position);
    ends_.clear();
    for (const Vec2& end : vcv_over_star(node)) ends_.push_back(at(end));
    draw_ground();
    draw_outline(colors_.casing, colors_.casing_alpha, 4 * unit_);
    draw_spokes(node.weights, false);
    draw_spokes(node.weights, true);
    draw_outline(colors_.line, 1, 2 * unit_);
    draw_number(node.node, node.physical.mean_length() / figure_.camera.units_per_pixel());
  }

 private:
  /// Draws the ground as one path: the background would show between triangles filled one by one.
  void draw_ground() {
    for (std::size_t k = 0; k < ends_.size(); ++k)
      add_polygon({centre_, ends_[k], ends_[(k + 1) % ends_.size()]});
    page_.set_color(colors_.fill, static_cast<double>(colors_.fill_alpha));
    page_.fill();
  }

  void draw_outline(const Rgb& color, float alpha, double width) {
    page_.set_color(color, static_cast<double>(alpha));
    page_.set_line(width, true);
    for (std::size_t k = 0; k < ends_.size(); ++k)
      add_line(ends_[k], ends_[(k + 1) % ends_.size()]);
    page_.stroke();
  }

  void draw_spokes(const std::vector<double>& weights, bool negative) {
    page_.set_color(negative ? colors_.negative : colors_.line);
    page_.set_line(1.3 * unit_, true);
    for (std::size_t k = 0; k < ends_.size(); ++k)
      if ((weights[k] < 0) == negative) add_line(centre_, ends_[k]);
    page_.stroke();
  }

  void draw_number(Index node, double room) {
    const std::string text = std::to_string(node);
    const double size = figure_.font_size;
    const double width = page_.text_width(text, size, FontWeight::regular);
    if (width > 1.1 * room) return;
    page_.set_color(colors_.casing, static_cast<double>(colors_.label_alpha));
    page_.rectangle(centre_.x() - width / 2 - 0.2 * size, centre_.y() - 0.6 * size,
                    width + 0.4 * size, 1.2 * size);
    page_.fill();
    page_.set_color(colors_.line);
    page_.text(centre_.x() - width / 2, centre_.y(), text, size, FontWeight::regular);
  }

  VcvColors colors_;
  double unit_;
  ScreenPoint centre_;
  std::vector<ScreenPoint> ends_;
};

}  // namespace

void draw_figure_vcvs(Page& page, const VectorFigure& figure, const ScreenPoint& origin) {
  const Bounds seen = figure.camera.visible();
  const Camera& camera = figure.camera;
  page.clip(origin.x(), origin.y(), camera.viewport_width(), camera.viewport_height());
  VcvDrawing drawing(page, figure, origin);
  for (const NodalView& node : figure.vcvs)
    if (vcv_in_sight(node, seen)) drawing.draw(node);
  page.unclip();
}

}  // namespace winslow::gui
