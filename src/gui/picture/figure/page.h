#pragma once

#include "gui/base/screen.h"
#include "gui/render/color_scale.h"
#include "gui/render/image.h"
#include "gui/widgets/theme.h"

struct _cairo;
struct _cairo_surface;

namespace winslow::gui {

enum class PageFormat { svg, pdf };

/// A colour without its opacity.
inline Rgb rgb(const std::array<float, 4>& c) { return {c[0], c[1], c[2]}; }

/// A page of vector graphics being drawn with cairo, in points, y down.
class Page {
 public:
  Page(PageFormat format, double width, double height);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  double width() const { return width_; }
  double height() const { return height_; }

  void set_color(const Rgb& color, double alpha = 1);
  void set_line(double width, bool round_ends);
  void move_to(double x, double y);
  void line_to(double x, double y);
  void close_path();
  void rectangle(double x, double y, double width, double height);
  void stroke();
  void fill();
  /// Fills, and draws the rim in the same colour, so that no background shows between neighbours.
  void fill_with_rim(double width);
  /// A picture of pixels, stretched over a rectangle {x, y, width, height}.
  void image(const Image& image, const std::array<double, 4>& rectangle);
  /// Only what is inside this rectangle is drawn, until unclip().
  void clip(double x, double y, double width, double height);
  void unclip();

  /// Draws a line of text; x: its left end, middle: the middle of its height. In an SVG, text lies
  /// above everything else, outside of clips. It can be searched and edited there, and has the font
  /// of the studio if the reader has it.
  void text(double x, double middle, const std::string& text, double size, FontWeight weight);
  double text_width(const std::string& text, double size, FontWeight weight);

  /// Ends the page and returns the content of the file. Throws Error if cairo failed.
  std::string finish();

 private:
  void set_font(double size, FontWeight weight);
  void add_text_element(double x, double y, const std::string& text, double size,
                        FontWeight weight);

  PageFormat format_;
  Rgb color_{0, 0, 0};  // of text
  double alpha_ = 1;
  std::string texts_;  // elements of an SVG
  double width_, height_;
  std::string content_;
  _cairo_surface* surface_ = nullptr;
  _cairo* cairo_ = nullptr;
};

/// Part of a line that lies inside a box; none if the line misses the box.
std::optional<std::array<ScreenPoint, 2>> clip_line(const ScreenPoint& a, const ScreenPoint& b,
                                                    const ScreenBox& box);

/// Part of a convex polygon that lies inside a box; fewer than three points if there is none.
std::vector<ScreenPoint> clip_polygon(std::vector<ScreenPoint> polygon, const ScreenBox& box);

}  // namespace winslow::gui
