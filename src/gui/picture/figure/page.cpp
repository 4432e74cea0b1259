#include "gui/picture/figure/page.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cstdio>

#include "core/error.h"

namespace winslow::gui {

namespace {

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void destroy_face(void* face) { FT_Done_Face(static_cast<FT_Face>(face)); }

/// Loads the font from its file, so that a figure does not depend on how the system maps names to
/// fonts.
cairo_font_face_t* load_font(const std::filesystem::path& file) {
  // Lives as long as the program, since cairo caches fonts.
  static FT_Library library = [] {
    FT_Library made = nullptr;
    return FT_Init_FreeType(&made) == 0 ? made : nullptr;
  }();
  FT_Face face = nullptr;
  if (!library || file.empty() || FT_New_Face(library, file.c_str(), 0, &face) != 0) return nullptr;
  cairo_font_face_t* font = cairo_ft_font_face_create_for_ft_face(face, 0);
  static const cairo_user_data_key_t key{};
  if (cairo_font_face_set_user_data(font, &key, face, destroy_face) != CAIRO_STATUS_SUCCESS) {
    cairo_font_face_destroy(font);
    FT_Done_Face(face);
    return nullptr;
  }
  return font;
}

cairo_font_face_t* font_of(FontWeight weight) {
  static cairo_font_face_t* const regular = load_font(font_file(FontWeight::regular));
  static cairo_font_face_t* const semibold = load_font(font_file(FontWeight::semibold));
  return weight == FontWeight::semibold ? semibold : regular;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

}  // namespace

Page::Page(PageFormat format, double width, double height)
    : format_(format), width_(width), height_(height) {
  if (format == PageFormat::svg) {
    surface_ = cairo_svg_surface_create_for_stream(append, &content_, width, height);
  } else {
    surface_ = cairo_pdf_surface_create_for_stream(append, &content_, width, height);
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATOR, "winslow");
  }
  cairo_ = cairo_create(surface_);
}

Page::~Page() {
  cairo_destroy(cairo_);
  cairo_surface_destroy(surface_);
}

void Page::set_color(const Rgb& c, double alpha) {
  color_ = c;
  alpha_ = alpha;
  cairo_set_source_rgba(cairo_, c[0], c[1], c[2], alpha);
}

void Page::set_line(double width, bool round_ends) {
  cairo_set_line_width(cairo_, width);
  cairo_set_line_cap(cairo_, round_ends ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
}

void Page::move_to(double x, double y) { cairo_move_to(cairo_, x, y); }
void Page::line_to(double x, double y) { cairo_line_to(cairo_, x, y); }
void Page::close_path() { cairo_close_path(cairo_); }
void Page::rectangle(double x, double y, double w, double h) {
  cairo_rectangle(cairo_, x, y, w, h);
}
void Page::stroke() { cairo_stroke(cairo_); }
void Page::fill() { cairo_fill(cairo_); }

void Page::fill_with_rim(double width) {
  set_line(width, true);
  cairo_fill_preserve(cairo_);
  cairo_stroke(cairo_);
}

void Page::image(const Image& image, const std::array<double, 4>& rectangle) {
  // Premultiplied, in the machine's byte order.
  std::vector<std::uint32_t> pixels;
  pixels.reserve(image.rgba.size() / 4);
  for (std::size_t k = 0; k + 3 < image.rgba.size(); k += 4) {
    const std::uint32_t a = image.rgba[k + 3];
    const auto part = [&](std::size_t c) { return image.rgba[k + c] * a / 255; };
    pixels.push_back(a << 24U | part(0) << 16U | part(1) << 8U | part(2));
  }
  cairo_surface_t* surface = cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32, image.width,
      image.height, 4 * image.width);
  cairo_save(cairo_);
  cairo_translate(cairo_, rectangle[0], rectangle[1]);
  cairo_scale(cairo_, rectangle[2] / image.width, rectangle[3] / image.height);
  cairo_set_source_surface(cairo_, surface, 0, 0);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
  // The page has a copy of the picture only once its surface is finished.
  cairo_surface_flush(surface_);
  cairo_surface_finish(surface);
  cairo_surface_destroy(surface);
}

void Page::clip(double x, double y, double w, double h) {
  cairo_save(cairo_);
  cairo_rectangle(cairo_, x, y, w, h);
  cairo_clip(cairo_);
}

void Page::unclip() { cairo_restore(cairo_); }

void Page::set_font(double size, FontWeight weight) {
  if (cairo_font_face_t* font = font_of(weight))
    cairo_set_font_face(cairo_, font);
  else
    cairo_select_font_face(
        cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
        weight == FontWeight::semibold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, size);
}

void Page::text(double x, double middle, const std::string& text, double size, FontWeight weight) {
  // Half the height of a capital, where the eye sees the middle of a line.
  const double base = middle + 0.36 * size;
  if (format_ == PageFormat::svg) return add_text_element(x, base, text, size, weight);
  set_font(size, weight);
  cairo_move_to(cairo_, x, base);
  cairo_show_text(cairo_, text.c_str());
}

/// Adds text as an element of its own, since cairo writes text into an SVG as outlines.
void Page::add_text_element(double x, double y, const std::string& text, double size,
                            FontWeight weight) {
  const auto byte = [](float share) { return static_cast<int>(std::lround(255 * share)); };
  std::array<char, 320> start{};
  std::snprintf(start.data(), start.size(),
                "<text x=\"%.6g\" y=\"%.6g\" font-family=\"Inter, Helvetica, Arial, sans-serif\" "
                "font-size=\"%.6g\" font-weight=\"%d\" fill=\"#%02x%02x%02x\" "
                "fill-opacity=\"%.3g\" xml:space=\"preserve\">",
                x, y, size, weight == FontWeight::semibold ? 600 : 400, byte(color_[0]),
                byte(color_[1]), byte(color_[2]), alpha_);
  texts_ += start.data() + escaped(text) + "</text>\n";
}

double Page::text_width(const std::string& text, double size, FontWeight weight) {
  set_font(size, weight);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return extents.x_advance;
}

std::string Page::finish() {
  cairo_show_page(cairo_);
  cairo_surface_finish(surface_);
  for (const cairo_status_t status : {cairo_status(cairo_), cairo_surface_status(surface_)})
    if (status != CAIRO_STATUS_SUCCESS)
      throw Error(std::string("the figure could not be drawn: ") + cairo_status_to_string(status));
  // Above all else, before the end of the root element.
  if (const auto end = content_.rfind("</svg>"); format_ == PageFormat::svg && !texts_.empty()) {
    if (end == std::string::npos) throw Error("the figure could not be drawn: no SVG came of it");
    content_.insert(end, texts_);
  }
  return content_;
}

std::optional<std::array<ScreenPoint, 2>> clip_line(const ScreenPoint& a, const ScreenPoint& b,
                                                    const ScreenBox& box) {
  const auto part = part_within(a, b, box);
  if (!part) return std::nullopt;
  const ScreenVector d = b - a;
  return std::array<ScreenPoint, 2>{a + (*part)[0] * d, a + (*part)[1] * d};
}

std::vector<ScreenPoint> clip_polygon(std::vector<ScreenPoint> polygon, const ScreenBox& box) {
  // Sutherland and Hodgman: one side of the box after the other.
  for (const int axis : {0, 1})
    for (const bool upper : {false, true}) {
      const double limit = upper ? box.max[axis] : box.min[axis];
      const auto inside = [&](const ScreenPoint& p) {
        return upper ? p[axis] <= limit : p[axis] >= limit;
      };
      std::vector<ScreenPoint> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const ScreenPoint& p = polygon[k];
        const ScreenPoint& q = polygon[(k + 1) % polygon.size()];
        if (inside(p)) kept.push_back(p);
        if (inside(p) != inside(q))
          kept.emplace_back(p + (limit - p[axis]) / (q[axis] - p[axis]) * (q - p));
      }
      polygon = std::move(kept);
    }
  return polygon;
}

}  // namespace winslow::gui
