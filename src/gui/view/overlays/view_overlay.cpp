#include "gui/view/overlays/view_overlay.h"

#include <numbers>

#include "core/inspect/nodal_view.h"
#include "core/mesh/element_type.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/view/navigation/go_to.h"
#include "gui/view/overlays/vcv_overlay.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImU32 color_of(const Rgba& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

bool inside(const ScreenBox& seen, const ScreenPoint& p, double room) {
  const ScreenVector q = p - seen.min;
  const ScreenVector size = seen.size();
  return q.x() > -room && q.y() > -room && q.x() < size.x() + room && q.y() < size.y() + room;
}

/// Draws a chevron that points along a direction of the screen.
void draw_arrow(ImDrawList& list, const ViewOverlay& o, const ScreenPoint& at,
                const ScreenVector& along, ImU32 color) {
  const double size = static_cast<double>(o.theme.px(6));
  const ScreenVector across(-along.y(), along.x());
  const ScreenPoint tip = at + size * along;
  const ScreenPoint left = at - 0.5 * size * along + 0.7 * size * across;
  const ScreenPoint right = at - 0.5 * size * along - 0.7 * size * across;
  list.AddTriangleFilled(ImVec2(tip), ImVec2(left), ImVec2(right), color);
}

/// The edges of an element or a face; none for a node.
std::vector<std::array<Index, 2>> edges_of(const MeshItem& item, const Topology& topology) {
  std::vector<std::array<Index, 2>> edges;
  if (item.kind == MeshItem::Kind::face) {
    const Face nodes = topology.face(item.id).nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      edges.push_back({nodes[k], nodes[(k + 1) % nodes.size()]});
  }
  if (item.kind == MeshItem::Kind::element) {
    const auto corners = topology.element(item.id);
    for (const auto& edge : topology.shape(item.id).edges)
      edges.push_back({corners[at(edge[0])], corners[at(edge[1])]});
  }
  return edges;
}

/// Draws one closed loop of the boundary, the mesh on its left.
void draw_loop(ImDrawList& list, const ViewOverlay& o, const std::vector<Index>& nodes,
               ImU32 color) {
  const double arrow_gap = static_cast<double>(o.theme.px(64));
  const double node_gap = static_cast<double>(o.theme.px(7));
  double since_arrow = 0.5 * arrow_gap;
  ScreenPoint last_dot(-1e9, -1e9);
  ScreenPoint from = o.view.to_screen(o.session.coordinates().xy(nodes.back()));
  for (const Index node : nodes) {
    const ScreenPoint to = o.view.to_screen(o.session.coordinates().xy(node));
    const double length = (to - from).norm();
    since_arrow += length;
    if (o.options.directions && since_arrow >= arrow_gap && length > 0) {
      since_arrow = 0;
      const ScreenPoint middle = midpoint(from, to);
      if (inside(o.view.viewport(), middle, 0))
        draw_arrow(list, o, middle, (to - from) / length, color);
    }
    // Closer dots would merge into a thick line.
    if (o.options.rim_nodes && (to - last_dot).norm() >= node_gap &&
        inside(o.view.viewport(), to, 4)) {
      last_dot = to;
      list.AddCircleFilled(ImVec2(to), o.theme.px(3.4f), palette().card, 12);
      list.AddCircleFilled(ImVec2(to), o.theme.px(2.4f), color, 12);
    }
    from = to;
  }
}

}  // namespace

ImVec2 draw_tag(ImDrawList& list, const Theme& theme, const ImVec2& at, const char* text) {
  ImFont& font = *theme.small;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e6f, 0, text);
  const float pad = theme.px(7);
  const ImVec2 end(at.x + size.x + 2 * pad, at.y + size.y + pad);
  list.AddRectFilled(at, end, faded(palette().card, 0.92f), theme.px(5));
  list.AddRect(at, end, palette().border, theme.px(5));
  list.AddText(&font, font.FontSize, ImVec2(at.x + pad, at.y + pad / 2), palette().text, text);
  return {end.x - at.x, end.y - at.y};
}

void draw_focus(ImDrawList& list, const ViewOverlay& o) {
  const auto& focus = o.state.focus;
  if (!focus || !exists(*focus, o.session)) return;
  const Coordinates& x = o.session.coordinates();
  const auto place = [&](Index node) { return ImVec2(o.view.project(place_of(x, node)).at); };
  // The inspected node has a ring of its own.
  if (focus->kind == MeshItem::Kind::node && o.session.nodes().inspected() != focus->id) {
    const ImVec2 c = place(focus->id);
    list.AddCircle(c, o.theme.px(9), palette().card, 32, o.theme.px(5));
    list.AddCircle(c, o.theme.px(9), palette().accent, 32, o.theme.px(2.5f));
    list.AddCircleFilled(c, o.theme.px(2.5f), palette().accent);
  }
  // With a halo, so that the edges are legible over any colour.
  const auto edges = edges_of(*focus, *o.session.topology());
  for (const auto& [color, width] : {std::pair{palette().card, 5.5f}, {palette().accent, 2.5f}})
    for (const auto& [a, b] : edges) list.AddLine(place(a), place(b), color, o.theme.px(width));
  ui::note("focus", ImVec2(o.view.viewport().min), ImVec2(o.view.viewport().max));
}

void draw_pins(ImDrawList& list, const ViewOverlay& o) {
  std::vector<NodalView> pinned;
  for (const Index node : o.session.nodes().pinned())
    pinned.push_back(inspect_node(*o.session.vcv(), o.session.coordinates(), node));
  draw_vcvs(list, o.view, pinned, o.theme.px(1), o.theme.small);
}

void draw_rim(ImDrawList& list, const ViewOverlay& o) {
  if (!o.options.rim_nodes && !o.options.directions) return;
  const ImU32 color = color_of(mesh_colors(o.options).dark ? Rgba{0.95f, 0.96f, 1.0f, 1}
                                                           : Rgba{0.10f, 0.12f, 0.16f, 1});
  for (const auto& loop : o.session.topology()->boundary_loops())
    if (!loop.empty()) draw_loop(list, o, loop, color);
}

ScreenBox room_below_comparison(ScreenBox room, const ViewOptions& options, const Theme& theme) {
  if (options.comparison != Comparison::none)
    room.min = ScreenPoint(room.min.x(), room.min.y() + static_cast<double>(theme.px(34)));
  return room;
}

void draw_comparison(ImDrawList& list, const ViewOptions& options, const Theme& theme,
                     const ScreenBox& whole) {
  if (options.comparison == Comparison::none) return;
  const auto [origin, end] = whole;
  const auto x = static_cast<float>(origin.x());
  const auto y = static_cast<float>(origin.y());
  const auto width = static_cast<float>(end.x() - origin.x());
  const auto height = static_cast<float>(end.y() - origin.y());
  const float gap = theme.px(10);
  const char* before =
      options.before == BeforeState::loaded ? "As opened" : "Before the last command";
  if (options.comparison == Comparison::ghost) {
    const float line = theme.px(22);
    const ImVec2 at(x + gap, y + gap);
    const std::string text = std::string("          ") + before;
    const ImVec2 size = draw_tag(list, theme, at, text.c_str());
    const float middle = at.y + size.y / 2;
    // White edges would be invisible on a white card.
    list.AddRectFilled(ImVec2(at.x + theme.px(5), middle - theme.px(5)),
                       ImVec2(at.x + theme.px(9) + line, middle + theme.px(5)),
                       faded(palette().text, 0.5f), theme.px(2));
    list.AddLine(ImVec2(at.x + theme.px(7), middle), ImVec2(at.x + theme.px(7) + line, middle),
                 color_of(mesh_colors(options).ghost) | IM_COL32_A_MASK, theme.px(2));
    return;
  }
  const float middle = x + static_cast<float>(options.divider) * width;
  list.AddLine(ImVec2(middle, y), ImVec2(middle, y + height), palette().card, theme.px(5));
  list.AddLine(ImVec2(middle, y), ImVec2(middle, y + height), palette().accent, theme.px(2));
  const ImVec2 grip(middle, y + height / 2);
  list.AddCircleFilled(grip, theme.px(9), palette().card);
  list.AddCircle(grip, theme.px(9), palette().accent, 32, theme.px(2));
  for (const float side : {-1.0f, 1.0f})
    list.AddTriangleFilled(ImVec2(grip.x + side * theme.px(6), grip.y),
                           ImVec2(grip.x + side * theme.px(2), grip.y - theme.px(4)),
                           ImVec2(grip.x + side * theme.px(2), grip.y + theme.px(4)),
                           palette().accent);
  ImFont& font = *theme.small;
  const float text = font.CalcTextSizeA(font.FontSize, 1e6f, 0, before).x + theme.px(14);
  list.PushClipRect(ImVec2(x, y), ImVec2(middle, y + height), true);
  draw_tag(list, theme, ImVec2(middle - text - gap, y + gap), before);
  list.PopClipRect();
  list.PushClipRect(ImVec2(middle, y), ImVec2(x + width, y + height), true);
  draw_tag(list, theme, ImVec2(middle + gap, y + gap), "Now");
  list.PopClipRect();
}

void draw_zoom_box(ImDrawList& list, const Theme& theme, const ScreenBox& box) {
  list.AddRectFilled(ImVec2(box.min), ImVec2(box.max), palette().accent_soft);
  list.AddRect(ImVec2(box.min), ImVec2(box.max), palette().accent, 0, 0, theme.px(1.5f));
}

void draw_inset_source(ImDrawList& list, const Theme& theme, const Inset& inset) {
  if (!inset.pinned) return;
  const ImVec2 from(inset.source.min);
  const ImVec2 to(inset.source.max);
  const ScreenBox frame = inset.frame();
  list.AddRect(from, to, palette().card, 0, 0, theme.px(4));
  list.AddRect(from, to, palette().accent, 0, 0, theme.px(1.5f));
  list.AddLine(ImVec2(frame.centre()), ImVec2(inset.source.centre()), faded(palette().accent, 0.7f),
               theme.px(1.2f));
}

void draw_inset_frame(ImDrawList& list, const ViewOverlay& o, const Inset& inset) {
  const ScreenBox frame = inset.frame();
  const ImVec2 min(frame.min);
  const ImVec2 max(frame.max);
  list.AddRect(min, max, palette().card, 0, 0, o.theme.px(5));
  list.AddRect(min, max, palette().accent, 0, 0, o.theme.px(2));
  const std::string factor = "\xC3\x97 " + std::to_string(std::lround(o.options.magnifier.factor));
  draw_tag(list, o.theme, ImVec2(min.x + o.theme.px(6), min.y + o.theme.px(6)), factor.c_str());
}

void Lens::draw(ImDrawList& list, const ViewOverlay& overlay) {
  if (!inset_) return;
  draw_inset_source(list, overlay.theme, *inset_);
  list.AddCallback(
      [](const ImDrawList*, const ImDrawCmd* command) {
        static_cast<const Lens*>(command->UserCallbackData)->paint();
      },
      this);
  draw_inset_frame(list, overlay, *inset_);
}

void Lens::paint() const {
  if (!inset_) return;
  const std::optional<Camera> camera = part_of(inset_->camera, tile_);
  if (!camera) return;
  mesh_.draw_magnified(*camera, inset_->camera, static_cast<int>(tile_.size().y()));
}

namespace {

/// Draws dashes along closed lines of points in the mesh.
class DashedLines {
 public:
  DashedLines(ImDrawList& list, const View& view, const Theme& theme)
      : list_(list), view_(view), theme_(theme) {}

  void loop(const std::vector<Vec3>& points) {
    walked_ = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      segment(points[i], points[(i + 1) % points.size()]);
  }

 private:
  void segment(const Vec3& from, const Vec3& to) {
    const auto a = static_cast<ImVec2>(view_.project(from).at);
    const auto b = static_cast<ImVec2>(view_.project(to).at);
    const float period = theme_.px(dash + gap);
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!std::isfinite(length)) return;
    // Only part of a line much longer than the window is visible: draw it solid instead of in
    // thousands of dashes.
    if (length > 400 * period || length == 0) return list_.AddLine(a, b, ink(), width());
    for (float at = -walked_; at < length; at += period) {
      const float start = std::max(at, 0.0f), end = std::min(at + theme_.px(dash), length);
      if (end <= start) continue;
      const auto point = [&](float s) {
        return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length);
      };
      list_.AddLine(point(start), point(end), ink(), width());
    }
    walked_ = std::fmod(walked_ + length, period);
  }
  static ImU32 ink() { return palette().accent; }
  float width() const { return theme_.px(1.5f); }

  static constexpr float dash = 7, gap = 5;  // pixels at 100 %
  ImDrawList& list_;
  const View& view_;
  const Theme& theme_;
  float walked_ = 0;
};

std::vector<Vec3> circle(const Vec3& centre, double radius, const Vec3& u, const Vec3& v) {
  constexpr int sides = 96;
  std::vector<Vec3> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    points.emplace_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

void draw_rectangle(DashedLines& lines, const KeepOutside& keep) {
  const Vec3 a = *keep.corner, b = *keep.opposite;
  lines.loop({a, Vec3(b.x(), a.y(), 0), b, Vec3(a.x(), b.y(), 0)});
}

/// Draws the twelve edges of the box: two rectangles, and the edges between them.
void draw_box(DashedLines& lines, const KeepOutside& keep) {
  const Vec3 a = *keep.corner, b = *keep.opposite;
  const std::array<Vec3, 4> foot{Vec3(a.x(), a.y(), a.z()), Vec3(b.x(), a.y(), a.z()),
                                 Vec3(b.x(), b.y(), a.z()), Vec3(a.x(), b.y(), a.z())};
  std::vector<Vec3> low(foot.begin(), foot.end()), high = low;
  for (Vec3& point : high) point.z() = b.z();
  lines.loop(low);
  lines.loop(high);
  for (std::size_t k = 0; k < low.size(); ++k) lines.loop({low[k], high[k]});
}

void draw_sphere(DashedLines& lines, const Vec3& centre, double radius) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  for (const auto& [u, v] : {std::pair{x, y}, std::pair{y, z}, std::pair{z, x}})
    lines.loop(circle(centre, radius, u, v));
}

}  // namespace

void draw_region(ImDrawList& list, const Session& session, const View& view, const Theme& theme) {
  const KeepOutside& keep = session.solver_settings().smooth_options().keep_outside;
  if (!keep.given()) return;
  const bool space = session.in_space();
  DashedLines lines(list, view, theme);
  if (keep.corner && keep.opposite) space ? draw_box(lines, keep) : draw_rectangle(lines, keep);
  if (keep.radius) {
    // None: there is no selection around which to draw the circle.
    const auto centre =
        keep.centre ? std::optional<Vec3>(*keep.centre) : session.selection().own().centre();
    if (!centre) return;
    if (space)
      draw_sphere(lines, *centre, *keep.radius);
    else
      lines.loop(circle(*centre, *keep.radius, Vec3::UnitX(), Vec3::UnitY()));
  }
  const ScreenBox seen = view.viewport();
  ui::note("region", static_cast<ImVec2>(seen.min), static_cast<ImVec2>(seen.max));
}

namespace {

constexpr double lens_side = 230;  // units of the layout
constexpr double pinned_side = 270;
constexpr double margin = 14;

}  // namespace

std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const ScreenPoint& mouse, bool mouse_over, double scale) {
  if (!magnifier.on) return std::nullopt;
  const bool pinned = magnifier.pin.has_value();
  if (!pinned && !mouse_over) return std::nullopt;
  const ScreenPoint origin = camera.viewport_origin();
  const ScreenVector size(camera.viewport_width(), camera.viewport_height());
  const double side = std::floor(
      std::min((pinned ? pinned_side : lens_side) * scale, 0.6 * std::min(size.x(), size.y())));
  if (side < 40) return std::nullopt;
  Inset inset;
  inset.pinned = pinned;
  const Vec2 place =
      pinned ? Vec2((*magnifier.pin)[0], (*magnifier.pin)[1]) : camera.to_world(mouse);
  ScreenPoint corner;
  if (pinned) {
    // Bottom left: the legend is at the right.
    corner =
        ScreenPoint(origin.x() + margin * scale, origin.y() + size.y() - side - margin * scale);
  } else {
    const ScreenPoint wanted = mouse - ScreenVector(side / 2, side / 2);
    const ScreenPoint last = origin + size - ScreenVector(side, side);
    corner = {std::min(std::max(wanted.x(), origin.x()), last.x()),
              std::min(std::max(wanted.y(), origin.y()), last.y())};
  }
  corner = ScreenPoint(std::round(corner.x()), std::round(corner.y()));
  inset.camera.set_viewport(corner.x(), corner.y(), side, side);
  inset.camera.look_at(place, camera.units_per_pixel() / magnifier.factor);
  const ScreenPoint centre = camera.to_screen(place);
  const double half_side = 0.5 * side / magnifier.factor;
  const ScreenVector half(half_side, half_side);
  inset.source = {centre - half, centre + half};
  return inset;
}

double turned_factor(double factor, double notches) {
  return std::clamp(factor * std::pow(1.25, notches), 2.0, 1000.0);
}

}  // namespace winslow::gui
