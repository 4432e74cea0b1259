#include "gui/shell/workbench/regions.h"

#include <algorithm>

#include "gui/demos/demo_player.h"
#include "gui/panels/banner_panel.h"
#include "gui/panels/convergence_panel.h"
#include "gui/panels/demo_panel.h"
#include "gui/picture/capture/capture.h"
#include "gui/shell/workbench/folded_columns.h"
#include "gui/shell/workbench/panel_list.h"
#include "gui/shell/workbench/region_window.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// A strip that is dragged; returns by how many pixels.
float splitter(const char* name, const Area& area, bool upright) {
  begin_region(name, area, {ImVec2(0, 0), IM_COL32(0, 0, 0, 0), ImGuiWindowFlags_NoBackground});
  ImGui::InvisibleButton("grip", ImVec2(area.width, area.height));
  ui::note(name);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(area.x, area.y),
                                              ImVec2(area.x + area.width, area.y + area.height),
                                              palette().accent_soft);
  }
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  const float moved = ImGui::IsItemActive() ? (upright ? delta.x : delta.y) : 0;
  end_region(RegionEdge::none);
  return moved;
}

}  // namespace

Regions::Regions() : panels_(make_panels()) {}

bool Regions::shows_welcome(const Session& session) const {
  return !session.document() || welcome_.wanted();
}

void Regions::draw_menu(const PanelContext& context, WindowFrame& frame) const {
  float height = 0;
  if (ImGui::BeginMainMenuBar()) {
    height = ImGui::GetWindowSize().y;
    draw_panels(context, Region::menu);
    ImGui::EndMainMenuBar();
  }
  // The welcome page needs the room, and without a mesh the panels have nothing to say.
  const bool page = shows_welcome(context.session);
  frame.layout.plot_empty = ConvergencePanel::empty(context);
  frame.layout.arrange(frame.width, frame.height, context.view, context.theme, height,
                       page ? Layout::Middle::page : Layout::Middle::mesh);
}

void Regions::draw(const PanelContext& context, const Layout& layout) const {
  const Theme& theme = context.theme;
  const ImVec2 roomy(theme.px(12), theme.px(10));
  begin_region("toolbar", layout.toolbar,
               {ImVec2(theme.px(8), theme.px(8)), palette().card, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::toolbar);
  end_region();
  begin_region("status", layout.status,
               {ImVec2(theme.px(10), theme.px(6)), palette().card, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::status);
  end_region();
  if (!layout.left.empty() && layout.columns.left_open) {
    begin_region("left", layout.left, {roomy});
    draw_panels(context, Region::left);
    end_region();
  } else if (!layout.left.empty()) {
    draw_folded_left(context, layout.left);
  }
  if (!layout.right.empty() && layout.columns.right_open) {
    begin_region("right", layout.right, {roomy});
    draw_tabs(context);
    draw_panels(context, Region::right);
    end_region();
  } else if (!layout.right.empty()) {
    draw_folded_right(context, layout.right);
  }
  if (!layout.plot.empty()) {
    begin_region("plot", layout.plot,
                 {ImVec2(theme.px(12), theme.px(8)), palette().card, ImGuiWindowFlags_NoScrollbar});
    draw_panels(context, Region::plot);
    end_region();
  }
}

void Regions::draw_panels(const PanelContext& context, Region region) const {
  panels_.draw(region, context, context.session.kind());
}

void Regions::draw_tabs(const PanelContext& context) const {
  std::vector<ui::Tab> labels;
  std::size_t chosen = 0;
  for (const SideTabInfo& tab : side_tabs()) {
    if (tab.which == context.view.side_tab) chosen = labels.size();
    labels.push_back({tab.label, tab.tooltip});
  }
  if (ui::tabs("tab", labels, chosen))
    context.edit_view([&](ViewOptions& view) { view.side_tab = side_tabs()[chosen].which; });
}

std::optional<float> Regions::drag_splitters(const PanelContext& context, Layout& layout) const {
  const float scale = context.theme.scale;
  const float grip = 6 * scale;
  const Area& l = layout.left;
  const Area& r = layout.right;
  const Area& p = layout.plot;
  // A column grows as far as the other one leaves room.
  const float budget = Layout::most_columns * layout.toolbar.width;
  if (!l.empty() && layout.columns.left_open) {
    const float by =
        splitter("splitter/left", {l.x + l.width - grip / 2, l.y, grip, l.height}, true);
    if (by != 0) layout.left_width = std::min(l.width + by, budget - r.width) / scale;
  }
  if (!r.empty() && layout.columns.right_open) {
    const float by = splitter("splitter/right", {r.x - grip / 2, r.y, grip, r.height}, true);
    if (by != 0) layout.right_width = std::min(r.width - by, budget - l.width) / scale;
  }
  draw_fold_handles(context, layout);
  if (!p.empty() && !layout.plot_empty)
    layout.plot_height -=
        splitter("splitter/plot", {p.x, p.y - grip / 2, p.width, grip}, false) / scale;
  if (context.view.comparison != Comparison::split || !context.session.document())
    return std::nullopt;
  const Area& v = layout.viewport;
  const float middle = v.x + static_cast<float>(context.view.divider) * v.width;
  const float wide = 14 * scale;
  return splitter("splitter/compare", {middle - wide / 2, v.y, wide, v.height}, true);
}

void Regions::draw_over_mesh(const PanelContext& context, const Area& v, Cards cards) {
  const Theme& theme = context.theme;
  if (shows_welcome(context.session)) {
    // In the middle of a large window rather than in its corner.
    const float side = (v.width - theme.px(WelcomePanel::page_width)) / 2;
    const float top = (v.height - theme.px(WelcomePanel::page_height)) / 3;
    begin_region(
        "welcome", v,
        {ImVec2(std::max(theme.px(22), side), std::max(theme.px(18), top)), palette().card});
    welcome_.draw(context);
    end_region();
    return;
  }
  if (cards == Cards::all) draw_recording(context, v);
  if (context.demo.demo() && cards == Cards::all) draw_demo_card(context, v);
  if (!context.session.messages().banner() || cards == Cards::none) return;
  // It speaks of the mesh: of one that is seen.
  if (!context.picture_follows()) return;
  const Banner::Kind kind = context.session.messages().banner()->kind;
  const bool bad = kind == Banner::Kind::inverted_result || kind == Banner::Kind::inverted_input;
  begin_region(
      "banner", {v.x, v.y, v.width, BannerPanel::height(context, v.width)},
      {ImVec2(theme.px(BannerPanel::side_padding), theme.px(7)),
       bad ? palette().danger_soft : palette().warning_soft, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::banner);
  end_region();
}

void Regions::draw_demo_card(const PanelContext& context, const Area& v) const {
  const Theme& theme = context.theme;
  const float margin = theme.px(10);
  const ImVec2 padding(theme.px(14), theme.px(10));
  const float width = std::min(theme.px(460), v.width - 2 * margin);
  const float height =
      DemoPanel::height(context, width - 2 * padding.x) + 2 * padding.y + theme.px(2);
  begin_region("demo", {v.x + margin, v.y + v.height - height - margin, width, height},
               {padding, palette().card, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::demo);
  const ImVec2 corner = ImGui::GetWindowPos();
  ui::note("demo/card", corner, ImVec2(corner.x + width, corner.y + height));
  end_region();
}

void Regions::draw_recording(const PanelContext& context, const Area& v) const {
  if (context.capture.recorder().state() == Recorder::State::idle) return;
  const Theme& theme = context.theme;
  const float banner =
      context.session.messages().banner() ? BannerPanel::height(context, v.width) : 0;
  begin_region("recording",
               {v.x + theme.px(12), v.y + banner + theme.px(12), theme.px(360), theme.px(44)},
               {ImVec2(theme.px(12), theme.px(8)), palette().card, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::recording);
  end_region();
}

}  // namespace winslow::gui
