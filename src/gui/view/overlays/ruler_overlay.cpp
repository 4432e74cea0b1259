#include "gui/view/overlays/ruler_overlay.h"

#include <cstdio>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec2 projected(const ViewOverlay& o, const Vec3& p) { return ImVec2(o.view.project(p).at); }

std::string text_of(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

void draw_leg(ImDrawList& list, const ViewOverlay& o, const Vec3& a, const Vec3& b) {
  const ImVec2 from = projected(o, a), to = projected(o, b);
  list.AddLine(from, to, faded(palette().card, 0.85f), o.theme.px(5));
  list.AddLine(from, to, palette().accent, o.theme.px(2));
}

/// The angle that is measured, as an arc in the plane of both legs.
void draw_arc(ImDrawList& list, const ViewOverlay& o, const std::vector<RulerPoint>& points) {
  const Vec3 corner = points[1].at;
  const Vec3 a = points[0].at - corner, b = points[2].at - corner;
  const Vec3 u = a.normalized(), normal = a.cross(b);
  const Vec3 v = normal.norm() > 0 ? Vec3(normal.cross(a).normalized()) : Vec3(0, 0, 0);
  const double angle = std::atan2(normal.norm(), a.dot(b));
  const double radius = std::min({o.view.pixel_size(corner) * static_cast<double>(o.theme.px(34)),
                                  0.6 * a.norm(), 0.6 * b.norm()});
  constexpr int pieces = 32;
  for (int k = 0; k <= pieces; ++k) {
    const double t = angle * k / pieces;
    list.PathLineTo(projected(o, corner + radius * (std::cos(t) * u + std::sin(t) * v)));
  }
  list.PathStroke(palette().accent, 0, o.theme.px(2));
}

void draw_point(ImDrawList& list, const ViewOverlay& o, const RulerPoint& point) {
  const ImVec2 at = projected(o, point.at);
  list.AddCircleFilled(at, o.theme.px(5), palette().card);
  list.AddCircleFilled(at, o.theme.px(3.2f), palette().accent);
  // On a node, it is ringed.
  if (point.node) list.AddCircle(at, o.theme.px(8), palette().accent, 24, o.theme.px(1.5f));
}

/// Lines of text on one card beside a place, inside the view.
void draw_card(ImDrawList& list, const ViewOverlay& o, const ScreenPoint& beside,
               const std::vector<std::string>& lines) {
  const Theme& theme = o.theme;
  ImFont& font = *theme.small;
  const float pad = theme.px(7), step = font.FontSize + theme.px(3);
  float width = 0;
  for (const std::string& line : lines)
    width = std::max(width, font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, line.c_str()).x);
  const ImVec2 size(width + 2 * pad, static_cast<float>(lines.size()) * step + pad);
  const ImVec2 low(o.view.viewport().min), high(o.view.viewport().max);
  ImVec2 at(static_cast<float>(beside.x()) + theme.px(16),
            static_cast<float>(beside.y()) + theme.px(16));
  at.x = std::max(low.x, std::min(at.x, high.x - size.x - pad));
  at.y = std::max(low.y, std::min(at.y, high.y - size.y - pad));
  const ImVec2 end(at.x + size.x, at.y + size.y);
  list.AddRectFilled(at, end, faded(palette().card, 0.94f), theme.px(5));
  list.AddRect(at, end, palette().border, theme.px(5));
  for (std::size_t k = 0; k < lines.size(); ++k)
    list.AddText(&font, font.FontSize,
                 ImVec2(at.x + pad, at.y + pad / 2 + static_cast<float>(k) * step), palette().text,
                 lines[k].c_str());
  ui::note("ruler", at, end);
}

}  // namespace

std::vector<std::string> measurement_lines(const Measurement& m) {
  // Rounding errors of the nodes are no distance.
  const auto rounded = [](double value, double unit) {
    return std::abs(value) < 1e-9 * unit ? 0.0 : value;
  };
  const auto part = [&](Index k) { return text_of("%+.6g", rounded(m.along[k], m.length)); };
  std::vector<std::string> lines;
  lines.push_back("Length " + text_of("%.6g", m.length));
  lines.push_back("x " + part(0) + "   y " + part(1) + (m.direction ? "" : "   z " + part(2)));
  if (m.direction) lines.push_back(text_of("%.2f\xC2\xB0 against x", rounded(*m.direction, 180)));
  if (m.faces) lines.push_back("Between the faces " + text_of("%.2f\xC2\xB0", *m.faces));
  if (m.second) lines.push_back("Second length " + text_of("%.6g", *m.second));
  if (m.angle) lines.push_back("Angle " + text_of("%.2f\xC2\xB0", *m.angle));
  return lines;
}

void draw_ruler(ImDrawList& list, const ViewOverlay& o, const Ruler& ruler) {
  const std::vector<RulerPoint> points = ruler.drawn();
  const auto measured = measure(points);
  for (std::size_t k = 1; k < points.size(); ++k) draw_leg(list, o, points[k - 1].at, points[k].at);
  if (measured && measured->angle) draw_arc(list, o, points);
  for (const RulerPoint& point : points) draw_point(list, o, point);
  if (measured)
    draw_card(list, o, o.view.project(points.back().at).at, measurement_lines(*measured));
}

}  // namespace winslow::gui
