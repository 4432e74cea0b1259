#include "gui/shell/workbench/folded_columns.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "gui/shell/workbench/region_window.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// A part of the column on the left.
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

/// A narrow button that points the way the column goes.
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

/// As ui::tabs() names it.
std::string tab_id(std::string label) {
  std::ranges::transform(label, label.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "tab/" + label;
}

}  // namespace

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
    // Scripts find it by the tab's own name, too: whether there is room for the column depends on
    // the window.
    ui::note(tab_id(tab.label));
    if (!pressed) continue;
    context.edit_view([&](ViewOptions& view) {
      open_right(view, context.view_state.columns);
      view.side_tab = tab.which;
    });
  }
  end_strip();
}

void draw_fold_handles(const PanelContext& context, const Layout& layout) {
  const Theme& theme = context.theme;
  const Area& l = layout.left;
  const Area& r = layout.right;
  // Half way up the view: a strip below it would cover them in a low window.
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

}  // namespace winslow::gui
