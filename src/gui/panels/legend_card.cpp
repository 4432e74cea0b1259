#include "gui/panels/legend_card.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

void LegendCard::draw(ImDrawList& list, const PanelContext& context, const Area& area,
                      const Legend& legend) {
  bars_.reset();
  const Theme& theme = context.theme;
  const float height = std::min(theme.px(260), 0.55f * area.height);
  // The mesh matters more where there is little room.
  if (height < theme.px(90) || area.width < theme.px(330)) return;
  const LegendStyle style = style_of(theme);
  Legend plain = legend;
  plain.histogram.reset();
  // Under a long title there is room for the histogram in any case.
  const bool narrow = area.width < theme.px(560);
  const bool widens = legend_width(plain, style) + theme.px(16) < legend_width(legend, style);
  const Legend& shown = narrow && widens ? plain : legend;
  const float width = legend_width(shown, style);
  const float pad = theme.px(12);
  const float x = area.x + area.width - width - 2 * pad - theme.px(12);
  const float y = area.y + theme.px(12);
  const ImVec2 min(x, y);
  const ImVec2 max(x + width + 2 * pad, y + height + 2 * pad);
  list.AddRectFilled(min, max, faded(palette().card, 0.92f), theme.px(6));
  list.AddRect(min, max, palette().border, theme.px(6));
  draw_legend(list, x + pad, y + pad, height, shown, style);
  ui::note("legend", min, max);
  if (!context.view.isolation.on) return;
  bars_ = legend_bars(x + pad, y + pad, height, shown, style);
  scale_ = shown.scale;
  ui::note("legend/bars", ImVec2(bars_->left, bars_->top), ImVec2(bars_->right, bars_->bottom));
  draw_threshold(list, context, shown);
}

void LegendCard::draw_threshold(ImDrawList& list, const PanelContext& context,
                                const Legend& legend) {
  const Theme& theme = context.theme;
  const Isolation& isolation = context.view.isolation;
  if (!(legend.scale.high > legend.scale.low)) return;
  const auto t = static_cast<float>(legend.scale.share(isolation.threshold));
  const float y = bars_->bottom - t * (bars_->bottom - bars_->top);
  // What is faint in the mesh is so here.
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

bool LegendCard::take_pointer(const PanelContext& context, const ScreenPoint& mouse, bool pressed) {
  const bool began = pressed && !was_pressed_;
  was_pressed_ = pressed;
  if (!bars_ || !pressed) dragging_ = false;
  if (!bars_) return false;
  const auto x = static_cast<float>(mouse.x());
  const auto y = static_cast<float>(mouse.y());
  const float room = context.theme.px(8);
  const bool over = x > bars_->left - room && x < bars_->right + room && y > bars_->top - room &&
                    y < bars_->bottom + room;
  if (began && over) dragging_ = true;
  if (dragging_) {
    const double t = std::clamp((bars_->bottom - y) / (bars_->bottom - bars_->top), 0.0f, 1.0f);
    // Three digits: a pixel is not worth more.
    const double value = scale_.value_at(t);
    const double size = scale_.by_ratio() ? value : scale_.high - scale_.low;
    const double step = std::pow(10.0, std::floor(std::log10(size)) - 2);
    const double threshold = step * std::round(value / step);
    if (threshold != context.view.isolation.threshold)
      context.edit_view([&](ViewOptions& view) { view.isolation.threshold = threshold; });
  }
  return dragging_ || (over && !pressed);
}

}  // namespace winslow::gui
