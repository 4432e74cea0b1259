#include "gui/view/overlays/foot_overlay.h"

#include <cstdio>

#include "gui/view/mesh/mesh_colors.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Height of the bar with its number.
float draw_scale_bar(ImDrawList& list, const ViewOverlay& o, const ImVec2& bottom_left) {
  const double unit = o.view.pixel_size(o.view.to_plane(o.view.viewport().centre()));
  const double length = round_length(unit * static_cast<double>(o.theme.px(140)));
  const auto width = static_cast<float>(length / unit);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", length);
  ImFont& font = *o.theme.small;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text.data());
  const float pad = o.theme.px(6), tick = o.theme.px(5);
  const ImVec2 extent(std::max(width, size.x) + 2 * pad, size.y + tick + 1.5f * pad);
  const ImVec2 min(bottom_left.x, bottom_left.y - extent.y);
  const ImVec2 max(min.x + extent.x, bottom_left.y);
  list.AddRectFilled(min, max, faded(palette().card, 0.85f), o.theme.px(5));
  const float left = min.x + (extent.x - width) / 2, right = left + width;
  const float y = max.y - 0.75f * pad;
  const float thick = o.theme.px(1.5f);
  list.AddLine(ImVec2(left, y), ImVec2(right, y), palette().text, thick);
  list.AddLine(ImVec2(left, y - tick), ImVec2(left, y), palette().text, thick);
  list.AddLine(ImVec2(right, y - tick), ImVec2(right, y), palette().text, thick);
  list.AddText(&font, font.FontSize, ImVec2(min.x + (extent.x - size.x) / 2, min.y + 0.4f * pad),
               palette().text, text.data());
  ui::note("scale_bar", ImVec2(left, min.y), ImVec2(right, max.y));
  return extent.y;
}

}  // namespace

void draw_mode(ImDrawList& list, const Theme& theme, const ImVec2& bottom_left, float room,
               const std::string& text) {
  ImFont& font = *theme.small;
  const float pad = theme.px(8);
  const float wrap = std::max(room - 2 * pad, theme.px(80));
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, wrap, text.c_str());
  const ImVec2 min(bottom_left.x, bottom_left.y - size.y - 1.4f * pad);
  const ImVec2 max(min.x + size.x + 2 * pad, bottom_left.y);
  list.AddRectFilled(min, max, palette().accent, theme.px(5));
  list.AddText(&font, font.FontSize, ImVec2(min.x + pad, min.y + 0.7f * pad), palette().on_accent,
               text.c_str(), nullptr, wrap);
  ui::note("mode", min, max);
}

double round_length(double most) {
  if (!(most > 0) || !std::isfinite(most)) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double share : {5.0, 2.0})
    if (share * decade <= most) return share * decade;
  return decade;
}

std::string mode_text(const Session& session, const ViewState& state) {
  if (state.ruler)
    return session.in_space()
               ? "Ruler: click two points for a distance and the angle between the faces, a third "
                 "for the angle at the second. Clicks snap to nodes, not with Shift. Esc puts it "
                 "away."
               : "Ruler: click two points for a distance, a third for the angle. Clicks snap to "
                 "nodes, not with Shift. Esc puts it away.";
  if (state.box_zoom_armed) return "Zoom: drag a box. Esc leaves the view as it is.";
  if (session.selection().shape_edit().active)
    return "Editing boundary nodes: drag one; Shift+click holds more. E or Esc ends.";
  return {};
}

void draw_foot(ImDrawList& list, const ViewOverlay& o, const ScreenBox& room,
               const std::string& mode) {
  const float margin = o.theme.px(16);  // beside the handle of the column
  const auto width = static_cast<float>(room.size().x());
  ImVec2 at(static_cast<float>(room.min.x()) + margin, static_cast<float>(room.max.y()) - margin);
  if (o.options.scale_bar && width > o.theme.px(180))
    at.y -= draw_scale_bar(list, o, at) + o.theme.px(6);
  if (!mode.empty()) draw_mode(list, o.theme, at, width - 2 * margin, mode);
}

void draw_out_of_view(ImDrawList& list, const ViewOverlay& o) {
  if (anything_in_view(*o.session.topology(), o.session.coordinates(), o.view.visible())) return;
  constexpr const char* text = "Nothing in view. Home: fit all";
  ImFont& font = *o.theme.regular;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text);
  const ScreenPoint middle = o.view.viewport().centre();
  const float pad = o.theme.px(10);
  const ImVec2 min(static_cast<float>(middle.x()) - size.x / 2 - pad,
                   static_cast<float>(middle.y()) - size.y / 2 - pad);
  const ImVec2 max(min.x + size.x + 2 * pad, min.y + size.y + 2 * pad);
  list.AddRectFilled(min, max, palette().card, o.theme.px(6));
  list.AddRect(min, max, palette().border, o.theme.px(6));
  list.AddText(&font, font.FontSize, ImVec2(min.x + pad, min.y + pad), palette().text, text);
  ui::note("out_of_view", min, max);
}

namespace {

/// A segment and a box have a point in common (Liang and Barsky).
bool crosses(const Vec2& a, const Vec2& b, const Bounds& box) {
  double from = 0, to = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double by = b[axis] - a[axis];
    double near = box.min[axis] - a[axis], far = box.max[axis] - a[axis];
    if (by == 0) {
      if (near > 0 || far < 0) return false;
      continue;
    }
    near /= by;
    far /= by;
    from = std::max(from, std::min(near, far));
    to = std::min(to, std::max(near, far));
    if (from > to) return false;
  }
  return true;
}

/// The segment crosses the ray from p to the right.
bool right_of(const Vec2& p, const Vec2& a, const Vec2& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x();
}

}  // namespace

bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box) {
  const Vec2 middle = box.centre();
  bool inside = false;
  for (const auto& loop : topology.boundary_loops()) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = coordinates.xy(loop[k]);
      const Vec2 b = coordinates.xy(loop[(k + 1) % loop.size()]);
      if (crosses(a, b, box)) return true;
      if (right_of(middle, a, b)) inside = !inside;
    }
  }
  return inside;
}

}  // namespace winslow::gui
