#include "gui/panels/legend_card.h"

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::array<float, 4> rgba(ImU32 color) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  return {c.x, c.y, c.z, 1};
}

LegendStyle style_of(const Theme& theme) {
  LegendStyle style;
  style.font = theme.small;
  style.title_font = theme.small;
  style.font_size = theme.px(13);
  style.bar_width = theme.px(14);
  style.histogram_width = theme.px(44);
  style.text_color = rgba(palette().text);
  style.line_color = rgba(palette().text_faint);
  return style;
}

/// A legend without its title, which is drawn above it on as many lines as necessary.
Legend untitled(const Legend& legend) {
  Legend rest = legend;
  rest.title.clear();
  return rest;
}

/// The legend without its histogram if it does not fit the width.
Legend fitted(const Legend& legend, float width, const LegendStyle& style) {
  if (legend_width(legend, style) <= width) return legend;
  Legend plain = legend;
  plain.histogram.reset();
  return plain;
}

ScreenBox box_of(const Area& a) {
  return {ScreenPoint(a.x, a.y), ScreenPoint(a.x + a.width, a.y + a.height)};
}

ImVec2 corner(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

}  // namespace

Area LegendCard::Room::whole() const {
  if (strip.empty()) return view;
  const float x = std::min(view.x, strip.x);
  const float right = std::max(view.x + view.width, strip.x + strip.width);
  return {x, strip.y, right - x, strip.height};
}

void LegendCard::hide() {
  bars_.reset();
  frame_.reset();
  grip_.reset();
  over_ = carried_ = false;
}

void LegendCard::draw(ImDrawList& list, const PanelContext& context, const Room& room,
                      const Legend* legend) {
  bars_.reset();
  frame_.reset();
  room_ = room;
  if (!room.strip.empty())
    draw_strip(list, context, room.strip, legend);
  else if (legend)
    draw_card(list, context, room.view, *legend);
  if (frame_) ui::note("legend", corner(frame_->min), corner(frame_->max));
  if (carried_) draw_target(list, context);
}

void LegendCard::draw_strip(ImDrawList& list, const PanelContext& context, const Area& strip,
                            const Legend* legend) {
  const Theme& theme = context.theme;
  const bool right = context.view.legend_place == LegendPlace::right;
  const ImVec2 min(strip.x, strip.y);
  const ImVec2 max(strip.x + strip.width, strip.y + strip.height);
  list.AddRectFilled(min, max, palette().card);
  const float edge = right ? min.x : max.x;
  list.AddLine(ImVec2(edge, min.y), ImVec2(edge, max.y), palette().border, theme.px(1));
  frame_ = box_of(strip);
  // On the side away from the mesh, leave room for the column's fold handle.
  const float inner = theme.px(10), outer = theme.px(14);
  const float x = min.x + (right ? inner : outer);
  const float width = strip.width - inner - outer;
  const LegendStyle style = style_of(theme);
  if (!context.view.fill)
    list.AddText(style.font, style.font_size, ImVec2(x, min.y + theme.px(12)), palette().text_faint,
                 "Edges alone have no colours.", nullptr, width);
  if (!legend) return;
  const ImVec2 title =
      style.font->CalcTextSizeA(style.font_size, FLT_MAX, width, legend->title.c_str());
  const float top = min.y + theme.px(12);
  list.AddText(style.font, style.font_size, ImVec2(x, top), palette().text, legend->title.c_str(),
               nullptr, width);
  const float start = top + title.y + theme.px(12);
  const float height = std::min(max.y - theme.px(12) - start, theme.px(440));
  if (height < theme.px(60)) return;
  draw_bars(list, context, ImVec2(x, start), height, fitted(untitled(*legend), width, style));
}

void LegendCard::draw_card(ImDrawList& list, const PanelContext& context, const Area& view,
                           const Legend& legend) {
  const Theme& theme = context.theme;
  const float height = std::min(theme.px(260), 0.55f * view.height);
  // With little room, show the mesh without the legend.
  if (height < theme.px(90) || view.width < theme.px(230)) return;
  const LegendStyle style = style_of(theme);
  Legend plain = legend;
  plain.histogram.reset();
  // Under a long title there is always room for the histogram.
  const bool narrow = view.width < theme.px(560);
  const bool widens = legend_width(plain, style) + theme.px(16) < legend_width(legend, style);
  const Legend& shown = narrow && widens ? plain : legend;
  const float pad = theme.px(12), margin = theme.px(12);
  const ImVec2 size(legend_width(shown, style) + 2 * pad, height + 2 * pad);
  const LegendPlace place = context.view.legend_place;
  const bool left = place == LegendPlace::top_left || place == LegendPlace::bottom_left;
  const bool bottom = place == LegendPlace::bottom_left || place == LegendPlace::bottom_right;
  const ImVec2 min(left ? view.x + margin : view.x + view.width - size.x - margin,
                   bottom ? view.y + view.height - size.y - margin : view.y + margin);
  const ImVec2 max(min.x + size.x, min.y + size.y);
  list.AddRectFilled(min, max, faded(palette().card, 0.92f), theme.px(6));
  list.AddRect(min, max, palette().border, theme.px(6));
  frame_ = ScreenBox{ScreenPoint(min), ScreenPoint(max)};
  draw_bars(list, context, ImVec2(min.x + pad, min.y + pad), height, shown);
}

void LegendCard::draw_bars(ImDrawList& list, const PanelContext& context, const ImVec2& at,
                           float height, const Legend& legend) {
  const LegendStyle style = style_of(context.theme);
  draw_legend(list, at.x, at.y, height, legend, style);
  const LegendBars bars = legend_bars(at.x, at.y, height, legend, style);
  ui::note("legend/bars", ImVec2(bars.left, bars.top), ImVec2(bars.right, bars.bottom));
  if (!context.view.isolation.on) return;
  bars_ = bars;
  scale_ = legend.scale;
  draw_threshold(list, context, legend);
}

void LegendCard::draw_threshold(ImDrawList& list, const PanelContext& context,
                                const Legend& legend) {
  const Theme& theme = context.theme;
  const Isolation& isolation = context.view.isolation;
  if (!(legend.scale.high > legend.scale.low)) return;
  const auto t = static_cast<float>(legend.scale.share(isolation.threshold));
  const float y = bars_->bottom - t * (bars_->bottom - bars_->top);
  // Fade the values of elements that are faint in the mesh.
  const float from = isolation.above ? y : bars_->top;
  const float to = isolation.above ? bars_->bottom : y;
  list.AddRectFilled(ImVec2(bars_->left, from), ImVec2(bars_->right, to),
                     faded(palette().card, 0.65f));
  list.AddLine(ImVec2(bars_->left - theme.px(4), y), ImVec2(bars_->right + theme.px(2), y),
               palette().accent, theme.px(dragging_ ? 3.0f : 2.0f));
  list.AddTriangleFilled(ImVec2(bars_->left - theme.px(9), y - theme.px(5)),
                         ImVec2(bars_->left - theme.px(9), y + theme.px(5)),
                         ImVec2(bars_->left - theme.px(1), y), palette().accent);
}

/// Marks the place of the legend if it is dropped now.
void LegendCard::draw_target(ImDrawList& list, const PanelContext& context) const {
  const Theme& theme = context.theme;
  const Area whole = room_.whole();
  const ScreenVector size = frame_ ? frame_->size() : ScreenVector(100, 100);
  const float width = std::min(static_cast<float>(size.x()), 0.4f * whole.width);
  const bool left = target_ == LegendPlace::left || target_ == LegendPlace::top_left ||
                    target_ == LegendPlace::bottom_left;
  const bool bottom = target_ == LegendPlace::bottom_left || target_ == LegendPlace::bottom_right;
  const float height = docked(target_) ? whole.height : 0.4f * whole.height;
  const float gap = docked(target_) ? 0 : theme.px(12);
  const ImVec2 min(left ? whole.x + gap : whole.x + whole.width - width - gap,
                   bottom ? whole.y + whole.height - height - gap : whole.y + gap);
  const ImVec2 max(min.x + width, min.y + height);
  list.AddRectFilled(min, max, palette().accent_soft, theme.px(4));
  list.AddRect(min, max, palette().accent, theme.px(4), 0, theme.px(2));
}

LegendPlace LegendCard::place_at(const ScreenPoint& mouse) const {
  const Area whole = room_.whole();
  const double u = (mouse.x() - static_cast<double>(whole.x)) / static_cast<double>(whole.width);
  const double v = (mouse.y() - static_cast<double>(whole.y)) / static_cast<double>(whole.height);
  constexpr double edge = 0.15;
  if (v > 0.25 && v < 0.75) {
    if (u < edge) return LegendPlace::left;
    if (u > 1 - edge) return LegendPlace::right;
  }
  if (v < 0.5) return u < 0.5 ? LegendPlace::top_left : LegendPlace::top_right;
  return u < 0.5 ? LegendPlace::bottom_left : LegendPlace::bottom_right;
}

bool LegendCard::over_bars(const PanelContext& context, const ScreenPoint& mouse) const {
  if (!bars_) return false;
  const auto x = static_cast<float>(mouse.x());
  const auto y = static_cast<float>(mouse.y());
  const float room = context.theme.px(8);
  return x > bars_->left - room && x < bars_->right + room && y > bars_->top - room &&
         y < bars_->bottom + room;
}

void LegendCard::drag_threshold(const PanelContext& context, float y) const {
  const double t = std::clamp((bars_->bottom - y) / (bars_->bottom - bars_->top), 0.0f, 1.0f);
  // Round to three digits, the resolution of a pixel.
  const double value = scale_.value_at(t);
  const double size = scale_.by_ratio() ? value : scale_.high - scale_.low;
  const double step = std::pow(10.0, std::floor(std::log10(size)) - 2);
  const double threshold = step * std::round(value / step);
  if (threshold != context.view.isolation.threshold)
    context.edit_view([&](ViewOptions& view) { view.isolation.threshold = threshold; });
}

bool LegendCard::take_pointer(const PanelContext& context, const ScreenPoint& mouse, bool pressed) {
  const bool began = pressed && !was_pressed_;
  const bool let_go = !pressed && was_pressed_;
  was_pressed_ = pressed;
  const bool on_bars = over_bars(context, mouse);
  over_ = frame_ && frame_->contains(mouse) && !on_bars;
  if (began && on_bars) dragging_ = true;
  if (began && over_) grip_ = mouse;
  if (!bars_ || !pressed) dragging_ = false;
  if (dragging_) drag_threshold(context, static_cast<float>(mouse.y()));
  constexpr float slack = 6;
  if (grip_ && (mouse - *grip_).norm() > static_cast<double>(context.theme.px(slack)))
    carried_ = true;
  if (carried_) target_ = place_at(mouse);
  const bool mine = dragging_ || grip_ || ((on_bars || over_) && !pressed);
  if (!pressed) {
    if (carried_ && let_go)
      context.edit_view([&](ViewOptions& view) { view.legend_place = target_; });
    grip_.reset();
    carried_ = false;
  }
  return mine;
}

}  // namespace winslow::gui
