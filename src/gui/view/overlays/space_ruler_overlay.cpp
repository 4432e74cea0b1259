#include "gui/view/overlays/space_ruler_overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gui/view/overlays/ruler_overlay.h"

namespace winslow::gui {

namespace {

ImVec2 pixel(const SpaceOverlay& o, const Vec3& p) {
  return static_cast<ImVec2>(o.view.project(p).at);
}

std::string number_text(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

/// The angle that is measured, as an arc in the plane of both legs.
void draw_arc(ImDrawList& list, const SpaceOverlay& o,
              const std::vector<SpaceRuler::Point>& points) {
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
    list.PathLineTo(pixel(o, corner + radius * (std::cos(t) * u + std::sin(t) * v)));
  }
  list.PathStroke(palette().accent, 0, o.theme.px(2));
}

void draw_point(ImDrawList& list, const SpaceOverlay& o, const SpaceRuler::Point& point) {
  const ImVec2 at = pixel(o, point.at);
  list.AddCircleFilled(at, o.theme.px(5), palette().card);
  list.AddCircleFilled(at, o.theme.px(3.2f), palette().accent);
  // On a node, it is ringed.
  if (point.node) list.AddCircle(at, o.theme.px(8), palette().accent, 24, o.theme.px(1.5f));
}

}  // namespace

std::vector<std::string> measurement_lines(const SpaceMeasurement& m) {
  // Rounding errors of the nodes are no distance.
  const auto part = [&](Index k) {
    const double value = m.along[k];
    return number_text("%+.6g", std::abs(value) < 1e-9 * m.length ? 0.0 : value);
  };
  std::vector<std::string> lines;
  lines.push_back("Length " + number_text("%.6g", m.length));
  lines.push_back("x " + part(0) + "   y " + part(1) + "   z " + part(2));
  if (m.faces) lines.push_back("Between the faces " + number_text("%.2f\xC2\xB0", *m.faces));
  if (m.second) lines.push_back("Second length " + number_text("%.6g", *m.second));
  if (m.angle) lines.push_back("Angle " + number_text("%.2f\xC2\xB0", *m.angle));
  return lines;
}

void draw_space_ruler(ImDrawList& list, const SpaceOverlay& o, const SpaceRuler& ruler) {
  const std::vector<SpaceRuler::Point> points = ruler.drawn();
  const auto measured = measure(points);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const ImVec2 from = pixel(o, points[k - 1].at), to = pixel(o, points[k].at);
    list.AddLine(from, to, faded(palette().card, 0.85f), o.theme.px(5));
    list.AddLine(from, to, palette().accent, o.theme.px(2));
  }
  if (measured && measured->angle) draw_arc(list, o, points);
  for (const SpaceRuler::Point& point : points) draw_point(list, o, point);
  if (measured)
    draw_measurement_card(list, o.theme, o.view.viewport(), o.view.project(points.back().at).at,
                          measurement_lines(*measured));
}

}  // namespace winslow::gui
