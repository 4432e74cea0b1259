#include "gui/picture/figure/figure_vcvs.h"

#include <string>

#include "gui/picture/figure/clip.h"
#include "gui/view/overlays/vcv_shape.h"

namespace winslow::gui {

namespace {

constexpr double line_margin = 8;  // points around the viewport where lines go on

class VcvDrawing {
 public:
  VcvDrawing(Page& page, const VectorFigure& figure, const ScreenPoint& origin)
      : page_(page), figure_(figure), unit_(0.06 * figure.font_size) {
    const Camera& camera = figure.camera;
    area_ = {origin, origin + ScreenVector(camera.viewport_width(), camera.viewport_height())};
    box_ = {area_.min - ScreenVector(line_margin, line_margin),
            area_.max + ScreenVector(line_margin, line_margin)};
    shift_ = origin - camera.viewport_origin();
  }

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
  ScreenPoint at(const Vec2& world) const { return figure_.camera.to_screen(world) + shift_; }

  /// One path: between triangles that are filled one by one the ground would shine through.
  void draw_ground() {
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const auto part = clip_polygon({centre_, ends_[k], ends_[(k + 1) % ends_.size()]}, box_);
      if (part.size() < 3) continue;
      page_.move_to(part[0].x(), part[0].y());
      for (std::size_t i = 1; i < part.size(); ++i) page_.line_to(part[i].x(), part[i].y());
      page_.close_path();
    }
    page_.set_color(colors_.fill, static_cast<double>(colors_.fill_alpha));
    page_.fill();
  }

  void add_line(const ScreenPoint& a, const ScreenPoint& b) {
    const auto line = clip_line(a, b, box_);
    if (!line) return;
    page_.move_to((*line)[0].x(), (*line)[0].y());
    page_.line_to((*line)[1].x(), (*line)[1].y());
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

  Page& page_;
  const VectorFigure& figure_;
  VcvColors colors_;
  double unit_;
  ScreenBox area_, box_;
  ScreenVector shift_;
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
