#include "gui/view/overlays/layer_overlay.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/layers/layer_measures.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace {

/// Nodes of a planned column, the wall's first.
std::vector<ScreenPoint> points_of(const LayerColumn& column, const Coordinates& x,
                                   const View& view) {
  Vec2 at = x.xy(column.wall_node);
  std::vector<ScreenPoint> points{view.to_screen(at)};
  for (std::size_t k = 0; k < column.count(); ++k) {
    at += wanted_length(column, k) * column.direction;
    points.push_back(view.to_screen(at));
  }
  return points;
}

/// The outlines of layers that can be told apart on screen, and the last one.
void draw_outlines(ImDrawList& list, const Overlay& o, const std::vector<ScreenPoint>& a,
                   const std::vector<ScreenPoint>& b) {
  constexpr double apart = 2.5;  // pixels
  const std::size_t top = std::max(a.size(), b.size());
  ScreenPoint last = a.front();
  for (std::size_t k = 1; k < top; ++k) {
    const ScreenPoint from = a[std::min(k, a.size() - 1)];
    const ScreenPoint to = b[std::min(k, b.size() - 1)];
    if (k + 1 < top && (from - last).norm() < apart) continue;
    last = from;
    list.AddLine(ImVec2(from), ImVec2(to), faded(palette().accent, 0.7f), o.theme.px(1));
  }
}

double distance(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
  const double length = (b - a).squared_norm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * (b - a)).norm();
}

void draw_reason(ImDrawList& list, const Overlay& o, const LayerColumn& column) {
  const std::string text = short_number(column.thickness()) + " of " + short_number(column.asked) +
                           " thick: " + std::string(limit_name(column.limit));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 at(mouse.x + o.theme.px(18), mouse.y + o.theme.px(14));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = o.theme.px(7);
  list.AddRectFilled(at, ImVec2(at.x + size.x + 2 * pad, at.y + size.y + 1.4f * pad),
                     faded(palette().warning, 0.88f), o.theme.px(5));
  list.AddText(ImVec2(at.x + pad, at.y + 0.7f * pad), palette().card, text.c_str());
}

}  // namespace

void draw_layer_preview(ImDrawList& list, const Overlay& o) {
  const LayerStack* plan = o.session.jobs().layer_preview().plan();
  if (!plan || o.session.in_motion()) return;
  const Coordinates& x = o.session.jobs().layer_preview().coordinates();
  const ScreenPoint pointer(ImGui::GetIO().MousePos);
  double nearest = static_cast<double>(o.theme.px(6));
  const LayerColumn* pointed = nullptr;
  std::vector<std::vector<ScreenPoint>> columns;
  columns.reserve(plan->columns.size());
  for (const LayerColumn& column : plan->columns) {
    columns.push_back(points_of(column, x, o.view));
    const auto& points = columns.back();
    const bool cut = cut_short(column);
    list.AddLine(ImVec2(points.front()), ImVec2(points.back()),
                 cut ? palette().warning : palette().accent, o.theme.px(cut ? 2.0f : 1.0f));
    if (cut && points.size() == 1)
      list.AddCircleFilled(ImVec2(points.front()), o.theme.px(3), palette().warning);
    const double away = distance(pointer, points.front(), points.back());
    if (!cut || away > nearest) continue;
    nearest = away;
    pointed = &column;
  }
  // Under the outlines, which are too close together to have halos of their own.
  for (const ColumnPair& pair : plan->pairs)
    list.AddLine(ImVec2(columns[pair.left].back()), ImVec2(columns[pair.right].back()),
                 faded(palette().card, 0.85f), o.theme.px(4));
  for (const ColumnPair& pair : plan->pairs)
    draw_outlines(list, o, columns[pair.left], columns[pair.right]);
  if (pointed) draw_reason(list, o, *pointed);
}

}  // namespace winslow::gui
