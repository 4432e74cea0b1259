#include "gui/shell/workbench/regions.h"

#include <imgui_internal.h>

#include <cctype>

#include "gui/demos/demo_player.h"
#include "gui/panels/panels.h"
#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// No region takes the focus when it appears, since this would end a drag in another one.
constexpr ImGuiWindowFlags fixed =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;

struct RegionStyle {
  ImVec2 padding;
  ImU32 background = palette().panel;
  ImGuiWindowFlags flags = 0;
};
/// Begins an ImGui window that fills an area of the layout and contains the widgets up to
/// end_region(). name: unique.
void begin_region(const char* name, const Area& area, const RegionStyle& style) {
  ImGui::SetNextWindowPos(ImVec2(area.x, area.y));
  ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, style.background);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, style.padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin(name, nullptr, fixed | style.flags);
}

/// Border of a region.
enum class RegionEdge { line, none };
void end_region(RegionEdge edge = RegionEdge::line) {
  const ImVec2 min = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const ImVec2 max(min.x + size.x, min.y + size.y);
  if (edge == RegionEdge::line) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(min, max, false);
    list.AddRect(min, max, palette().border);
    list.PopClipRect();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

/// A part of the left column.
struct LeftPart {
  const char* section;
  const char* label;
  Icon icon;
};
constexpr std::array<LeftPart, 6> left_parts{
    {{"section/markers", "Bodies and markers", Icon::bodies},
     {"section/motion", "Move the selection", Icon::motion},
     {"section/shape", "Change the shape", Icon::shape},
     {"section/layers", "Layers", Icon::layers},
     {"section/solver", "Solver", Icon::solver},
     {"section/mesh", "Mesh", Icon::mesh}}};

/// An icon on a button as wide as the strip; without an icon font the first letter.
bool icon_button(const Theme& theme, const std::string& id, Icon icon, const std::string& label,
                 const std::string& tooltip, bool present) {
  const std::string glyph = theme.icon(icon);
  if (present) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
  const bool pressed = ui::button(id, glyph.empty() ? label.substr(0, 1) : glyph,
                                  {label + ": " + tooltip, ui::ButtonStyle::flat, true, -1});
  if (present) ImGui::PopStyleColor();
  return pressed;
}

void begin_strip(const char* name, const Theme& theme, const Area& area) {
  begin_region(name, area,
               {ImVec2(theme.px(5), theme.px(8)), palette().panel, ImGuiWindowFlags_NoScrollbar});
  // The strip is no wider than an icon.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(theme.px(2), theme.px(6)));
}

void end_strip() {
  ImGui::PopStyleVar();
  end_region();
}

/// A narrow button that points in the direction in which the column folds.
bool fold_handle(const char* id, const Theme& theme, const ImVec2& min, ImGuiDir way,
                 const char* tooltip) {
  const ImVec2 size(theme.px(12), theme.px(48));
  begin_region(id, {min.x, min.y, size.x, size.y},
               {ImVec2(0, 0), IM_COL32(0, 0, 0, 0), ImGuiWindowFlags_NoBackground});
  const bool pressed = ImGui::InvisibleButton("fold", size);
  ui::note(id);
  const bool over = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 max(min.x + size.x, min.y + size.y);
  list.AddRectFilled(min, max, faded(palette().card, 0.92f), theme.px(4));
  list.AddRect(min, max, over ? palette().accent : palette().border, theme.px(4));
  const float arrow = 0.65f;
  ImGui::RenderArrow(&list,
                     ImVec2(min.x + (size.x - arrow * ImGui::GetFontSize()) / 2,
                            min.y + (size.y - arrow * ImGui::GetFontSize()) / 2),
                     over ? palette().accent : palette().text_dim, way, arrow);
  ui::tooltip(tooltip);
  end_region(RegionEdge::none);
  return pressed;
}

/// The id of a tab in ui::tabs().
std::string tab_id(std::string label) {
  std::ranges::transform(label, label.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "tab/" + label;
}

/// A tab of the right column.
struct SideTabInfo {
  SideTab which;
  std::string label, tooltip;
  Icon icon;
};
std::span<const SideTabInfo> side_tabs() {
  static const std::array<SideTabInfo, 4> tabs{
      {{SideTab::quality, "Quality", "How good the mesh is, before and now, and where it is worst.",
        Icon::quality},
       {SideTab::view, "View", "What is drawn, and how.", Icon::view},
       {SideTab::vcv, "VCV", "A node's virtual control volume: what it says, and how to change it.",
        Icon::nodes},
       {SideTab::history, "History", "What was done to the mesh; go back to any point.",
        Icon::history}}};
  return tabs;
}

// Folded columns beside the mesh: a strip of icons, each of which opens the column at one part.

void draw_folded_left(const PanelContext& context, const Area& area) {
  begin_strip("folded/left", context.theme, area);
  for (const LeftPart& part : left_parts) {
    const std::string id = std::string("open/") + part.section;
    if (!icon_button(context.theme, id, part.icon, part.label, "open this column here (F2).",
                     false))
      continue;
    ui::reveal(part.section);
    context.edit_view([&](ViewOptions& view) { open_left(view, context.view_state.columns); });
  }
  end_strip();
}

void draw_folded_right(const PanelContext& context, const Area& area) {
  begin_strip("folded/right", context.theme, area);
  for (const SideTabInfo& tab : side_tabs()) {
    const bool present = tab.which == context.view.side_tab;
    std::string id = "open/tab/" + tab.label;
    const bool pressed = icon_button(context.theme, id, tab.icon, tab.label, tab.tooltip, present);
    // Also note the tab's id, since the column may be folded or open depending on the window's
    // size.
    ui::note(tab_id(tab.label));
    if (!pressed) continue;
    context.edit_view([&](ViewOptions& view) {
      open_right(view, context.view_state.columns);
      view.side_tab = tab.which;
    });
  }
  end_strip();
}

/// Handles at the columns' edges that fold them.
void draw_fold_handles(const PanelContext& context, const Layout& layout) {
  const Theme& theme = context.theme;
  const Area& l = layout.left;
  const Area& r = layout.right;
  // At half the height of the view, where the strip below does not cover them in a low window.
  const Area& view = layout.viewport;
  const float top = view.y + view.height / 2 - theme.px(24);
  if (!l.empty() && layout.columns.left_open &&
      fold_handle("fold/left", theme, ImVec2(l.x + l.width, top), ImGuiDir_Left,
                  "Fold this column to icons (F2)."))
    context.edit_view([&](ViewOptions& v) { fold_left(v, context.view_state.columns); });
  if (!r.empty() && layout.columns.right_open &&
      fold_handle("fold/right", theme, ImVec2(r.x - theme.px(12), top), ImGuiDir_Right,
                  "Fold this column to icons (F3)."))
    context.edit_view([&](ViewOptions& v) { fold_right(v, context.view_state.columns); });
}

/// A strip that can be dragged; returns the pixels by which it was dragged.
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

void draw_tabs(const PanelContext& context) {
  std::vector<ui::Tab> labels;
  std::size_t chosen = 0;
  for (const SideTabInfo& tab : side_tabs()) {
    if (tab.which == context.view.side_tab) chosen = labels.size();
    labels.push_back({tab.label, tab.tooltip});
  }
  if (ui::tabs("tab", labels, chosen))
    context.edit_view([&](ViewOptions& view) { view.side_tab = side_tabs()[chosen].which; });
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
  // The welcome page needs the space, and without a mesh the panels are empty.
  const bool page = shows_welcome(context.session);
  frame.layout.plot_empty = convergence_empty(context);
  frame.layout.arrange(frame.width, frame.height, context.view, context.theme, height,
                       page ? Layout::Middle::page : Layout::Middle::mesh);
}

void Regions::draw(const PanelContext& context, const Layout& layout) const {
  const Theme& theme = context.theme;
  const ImVec2 roomy(theme.px(12), theme.px(10));
  const auto strip = [&](const char* name, const Area& area, const ImVec2& padding, Region region) {
    begin_region(name, area, {padding, palette().card, ImGuiWindowFlags_NoScrollbar});
    draw_panels(context, region);
    end_region();
  };
  strip("toolbar", layout.toolbar, ImVec2(theme.px(8), theme.px(8)), Region::toolbar);
  strip("status", layout.status, ImVec2(theme.px(10), theme.px(6)), Region::status);
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
  if (!layout.plot.empty())
    strip("plot", layout.plot, ImVec2(theme.px(12), theme.px(8)), Region::plot);
}

void Regions::draw_panels(const PanelContext& context, Region region) const {
  panels_.draw(region, context, context.session.kind());
}

std::optional<float> Regions::drag_splitters(const PanelContext& context, Layout& layout) const {
  const float scale = context.theme.scale;
  const float grip = 6 * scale;
  const Area& l = layout.left;
  const Area& r = layout.right;
  const Area& p = layout.plot;
  // A column can grow only into the space left by the other one.
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
    // Centred in a large window.
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
  // The banner must refer to the mesh in the picture.
  if (!context.picture_follows()) return;
  const Banner::Kind kind = context.session.messages().banner()->kind;
  const bool bad = kind == Banner::Kind::inverted_result || kind == Banner::Kind::inverted_input;
  begin_region(
      "banner", {v.x, v.y, v.width, banner_height(context, v.width)},
      {ImVec2(theme.px(banner_padding), theme.px(7)),
       bad ? palette().danger_soft : palette().warning_soft, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::banner);
  end_region();
}

void Regions::draw_demo_card(const PanelContext& context, const Area& v) const {
  const Theme& theme = context.theme;
  const float margin = theme.px(10);
  const ImVec2 padding(theme.px(14), theme.px(10));
  const float width = std::min(theme.px(460), v.width - 2 * margin);
  const float height = demo_height(context, width - 2 * padding.x) + 2 * padding.y + theme.px(2);
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
  const float banner = context.session.messages().banner() ? banner_height(context, v.width) : 0;
  begin_region("recording",
               {v.x + theme.px(12), v.y + banner + theme.px(12), theme.px(360), theme.px(44)},
               {ImVec2(theme.px(12), theme.px(8)), palette().card, ImGuiWindowFlags_NoScrollbar});
  draw_panels(context, Region::recording);
  end_region();
}

}  // namespace winslow::gui
