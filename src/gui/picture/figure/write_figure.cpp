#include "gui/picture/figure/vector_figure.h"

#include "core/error.h"
#include "gui/files/file_kinds.h"
#include "gui/picture/figure/page.h"
#include "gui/picture/frame/picture_frame.h"
#include "io/file/atomic_file.h"

namespace winslow::gui {

namespace {

constexpr double title_scale = 1.25;

/// Draws title, legend and key around the mesh.
class FigureDrawing {
 public:
  FigureDrawing(Page& page, const VectorFigure& figure)
      : page_(page), figure_(figure), theme_(picture_theme(figure.dark)), em_(figure.font_size) {}

  FigureMargins margins() {
    FigureMargins m{em_, em_, em_, em_};
    if (!figure_.title.empty()) m.top = 2.9 * em_;
    if (!figure_.key.empty() || !figure_.warning.empty() || !figure_.note.empty())
      m.bottom = 2.6 * em_;
    if (figure_.legend) m.right = legend_width() + 2.5 * em_;
    return m;
  }

  void draw() {
    const FigureMargins m = margins();
    page_.set_color(rgb(theme_.paper));
    page_.rectangle(0, 0, page_.width(), page_.height());
    page_.fill();
    const double width = page_.width() - m.left - m.right;
    const double height = page_.height() - m.top - m.bottom;
    if (figure_.scene) {
      draw_figure_scene(page_, *figure_.scene, {m.left, m.top}, {width, height}, em_,
                        rgb(theme_.ink));
    } else {
      draw_figure_mesh(page_, figure_, figure_.camera, {m.left, m.top});
      draw_figure_vcvs(page_, figure_, {m.left, m.top});
      if (figure_.inset) draw_inset(*figure_.inset, {m.left, m.top});
    }
    if (figure_.framed) {
      page_.set_color(rgb(theme_.frame));
      page_.set_line(0.5, false);
      page_.rectangle(m.left, m.top, width, height);
      page_.stroke();
    }
    if (!figure_.title.empty()) {
      page_.set_color(rgb(theme_.ink));
      page_.text(m.left, 1.5 * em_, figure_.title, title_scale * em_, FontWeight::semibold);
    }
    if (figure_.legend) {
      const double tall = std::min(height, 30 * em_);
      draw_legend({m.left + width + 1.5 * em_, m.top + 0.5 * (height - tall)}, tall);
    }
    draw_bottom_line(m.left);
  }

 private:
  double legend_width() {
    const Legend& legend = *figure_.legend;
    double ticks = 0;
    for (const LegendTick& tick : legend_ticks(legend, 8))
      ticks = std::max(ticks, page_.text_width(tick.text, em_, FontWeight::regular));
    return std::max(bar_width() + 0.8 * em_ + ticks,
                    page_.text_width(legend.title, em_, FontWeight::semibold));
  }
  double bar_width() const { return figure_.legend->histogram ? 4 * em_ : em_; }

  void draw_legend(const ScreenPoint& at, double height) {
    const Legend& legend = *figure_.legend;
    page_.set_color(rgb(theme_.ink));
    page_.text(at.x(), at.y() + 0.5 * em_, legend.title, em_, FontWeight::semibold);
    const double top = at.y() + 1.7 * em_;
    double bottom = at.y() + height - 0.5 * em_;
    if (legend.inverted) {
      page_.set_color(*legend.inverted);
      page_.rectangle(at.x(), bottom - 0.5 * em_, em_, em_);
      page_.fill();
      page_.set_color(rgb(theme_.ink));
      page_.text(at.x() + 1.4 * em_, bottom, "inverted", em_, FontWeight::regular);
      bottom -= 2 * em_;
    }
    if (bottom - top < em_) return;
    draw_bar(at.x(), top, em_, bottom - top, 1);
    if (legend.histogram) draw_histogram(at.x() + em_, top, bottom - top);
    page_.set_color(rgb(theme_.frame));
    page_.set_line(0.5, false);
    page_.rectangle(at.x(), top, bar_width(), bottom - top);
    page_.stroke();
    const int wanted = std::clamp(static_cast<int>((bottom - top) / (3.5 * em_)), 2, 8);
    const bool extended = legend.scale.high > legend.scale.low;
    for (const LegendTick& tick : legend_ticks(legend, wanted)) {
      const double t = extended ? legend.scale.share(tick.value) : 0.5;
      const double y = bottom - t * (bottom - top);
      const double x = at.x() + bar_width();
      page_.set_color(rgb(theme_.frame));
      page_.set_line(0.5, false);
      page_.move_to(x, y);
      page_.line_to(x + 0.4 * em_, y);
      page_.stroke();
      page_.set_color(rgb(theme_.ink));
      page_.text(x + 0.8 * em_, y, tick.text, em_, FontWeight::regular);
    }
  }

  void draw_bar(double x, double top, double width, double height, double alpha) {
    const ColorScale& scale = figure_.legend->scale;
    const int strips = scale.strips(scale.diverges() ? 256 : 128);
    const double step = height / strips;
    for (int k = 0; k < strips; ++k) {
      const double t = (k + 0.5) / strips;
      page_.set_color(scale.color(scale.value_at(t)), alpha);
      // Opaque strips overlap a little, so that no background shows between them.
      const double more = alpha == 1 && k + 1 < strips ? 0.3 : 0.0;
      page_.rectangle(x, top + height - (k + 1) * step - more, width, step + more);
      page_.fill();
    }
  }

  /// Draws bars by the square root of the counts, as on screen.
  void draw_histogram(double x, double top, double height) {
    const Legend& legend = *figure_.legend;
    const auto& counts = legend.histogram->counts;
    if (counts.empty()) return;
    const double room = 3 * em_ - 1;
    const Index most = *std::ranges::max_element(counts);
    const double step = height / static_cast<double>(counts.size());
    for (std::size_t k = 0; k < counts.size() && most > 0; ++k) {
      if (counts[k] <= 0) continue;
      const double share = std::sqrt(static_cast<double>(counts[k]) / most);
      const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(counts.size());
      page_.set_color(legend.scale.color(legend.scale.value_at(t)));
      page_.rectangle(x, top + height - static_cast<double>(k + 1) * step + 0.2,
                      std::max(share * room, 1.0), step - 0.4);
      page_.fill();
    }
  }

  /// Draws a frame around the inset, a frame around its source, and a line between them.
  void draw_inset(const FigureInset& inset, const ScreenPoint& origin) {
    const ScreenVector shift = origin - figure_.camera.viewport_origin();
    const ScreenPoint at = inset.camera.viewport_origin() + shift;
    const ScreenVector size(inset.camera.viewport_width(), inset.camera.viewport_height());
    const ScreenPoint from = inset.source.min + shift;
    const ScreenVector extent = inset.source.size();
    const ScreenPoint middle = from + 0.5 * extent, centre = at + 0.5 * size;
    page_.clip(origin.x(), origin.y(), figure_.camera.viewport_width(),
               figure_.camera.viewport_height());
    page_.set_color(rgb(theme_.ink));
    page_.set_line(0.1 * em_, true);
    page_.rectangle(from.x(), from.y(), extent.x(), extent.y());
    page_.move_to(centre.x(), centre.y());
    page_.line_to(middle.x(), middle.y());
    page_.stroke();
    page_.set_color(rgb(theme_.paper));
    page_.rectangle(at.x(), at.y(), size.x(), size.y());
    page_.fill();
    page_.unclip();
    draw_figure_mesh(page_, figure_, inset.camera, at);
    page_.set_color(rgb(theme_.ink));
    page_.set_line(0.15 * em_, true);
    page_.rectangle(at.x(), at.y(), size.x(), size.y());
    page_.stroke();
  }

  void draw_bottom_line(double left) {
    const double y = page_.height() - 1.25 * em_;
    double x = left;
    if (!figure_.warning.empty()) {
      page_.set_color(rgb(theme_.warning));
      page_.text(x, y, figure_.warning, em_, FontWeight::semibold);
      x += page_.text_width(figure_.warning, em_, FontWeight::semibold) + 2 * em_;
    }
    if (!figure_.note.empty()) {
      page_.set_color(rgb(theme_.ink));
      page_.text(x, y, figure_.note, em_, FontWeight::regular);
      x += page_.text_width(figure_.note, em_, FontWeight::regular) + 2 * em_;
    }
    for (const auto& [name, color] : figure_.key) {
      const double needed = 1.9 * em_ + page_.text_width(name, em_, FontWeight::regular);
      if (x + needed > page_.width() - em_) break;
      page_.set_color(color);
      page_.set_line(std::max(1.5, 0.2 * em_), false);
      page_.move_to(x, y);
      page_.line_to(x + 1.4 * em_, y);
      page_.stroke();
      page_.set_color(rgb(theme_.ink));
      page_.text(x + 1.9 * em_, y, name, em_, FontWeight::regular);
      x += needed + 1.5 * em_;
    }
  }

  Page& page_;
  const VectorFigure& figure_;
  const PictureTheme& theme_;
  double em_;
};

// Fonts are shared, and FreeType's faces belong to one thread at a time.
std::mutex drawing;

}  // namespace

bool is_vector_format(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending == ".svg" || ending == ".pdf";
}

void check_picture_name(const std::filesystem::path& path) {
  if (is_vector_format(path) || lower_case(path.extension().string()) == ".png") return;
  throw UsageError(path.string() + ": pictures are written as .png, .svg or .pdf");
}

FigureMargins figure_margins(const VectorFigure& figure) {
  const std::lock_guard lock(drawing);
  Page page(PageFormat::svg, 1, 1);
  return FigureDrawing(page, figure).margins();
}

VectorFigure begin_figure(const PictureText& text, bool dark, int width, int height) {
  VectorFigure figure;
  figure.dark = dark;
  figure.title = text.title;
  figure.warning = text.warning;
  figure.note = text.note;
  figure.key = text.key;
  figure.legend = text.legend;
  figure.font_size = std::clamp(0.02 * std::min(width, height), 8.0, 40.0);
  const FigureMargins m = figure_margins(figure);
  figure.camera.set_viewport(0, 0, std::max(width - m.left - m.right, 1.0),
                             std::max(height - m.top - m.bottom, 1.0));
  return figure;
}

void write_figure(const std::filesystem::path& path, const VectorFigure& figure) {
  if (!is_vector_format(path))
    throw UsageError(path.string() + ": a figure is written as .svg or .pdf");
  const FigureMargins m = figure_margins(figure);
  const std::lock_guard lock(drawing);
  Page page(lower_case(path.extension().string()) == ".svg" ? PageFormat::svg : PageFormat::pdf,
            figure.camera.viewport_width() + m.left + m.right,
            figure.camera.viewport_height() + m.top + m.bottom);
  FigureDrawing(page, figure).draw();
  std::string content;
  try {
    content = page.finish();
  } catch (const Error& error) {
    throw OutputError(path.string() + ": " + error.what());
  }
  io::write_atomically(path, [&](std::ostream& out) {
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
  });
}

}  // namespace winslow::gui
