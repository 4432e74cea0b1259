#include "gui/panels/markers_panel.h"

#include <algorithm>

#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

void MarkersPanel::draw(const PanelContext& context) {
  if (!ui::section("section/markers", "Bodies and markers")) return;
  const Topology* topology = context.topology();
  if (!topology) {
    ui::text_dim("No mesh is open.");
    return;
  }
  const auto count = static_cast<Index>(topology->markers().size());
  if (!topology->markers().from_file())
    ui::text_wrapped("The file names no markers; each boundary loop is listed as one.");
  const float row = ImGui::GetTextLineHeight() + 2 * context.theme.px(6);
  const float height = row * static_cast<float>(std::clamp(count, 1, 8)) + context.theme.px(4);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("markers", ImVec2(0, height), true);
  for (Index m = 0; m < count; ++m) draw_row(context, m);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

void MarkersPanel::draw_row(const PanelContext& context, Index marker) {
  const Topology& topology = *context.topology();
  const Marker& data = topology.markers()[static_cast<std::size_t>(marker)];
  const bool selected = context.session.selection().contains(marker);
  const auto& hovered = context.session.selection().hovered();
  const bool lit = std::find(hovered.begin(), hovered.end(), marker) != hovered.end();
  const float pad = context.theme.px(6);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() + 2 * pad);

  ImGui::PushID(marker);
  const bool pressed = ImGui::InvisibleButton("row", size);
  ui::note("marker/" + data.name);
  const bool over = ImGui::IsItemHovered();
  ui::tooltip("Click to select " + data.name +
              ": selected bodies move, the others stay. Ctrl+click adds or removes; a double "
              "click looks at it.\n" +
              counted(data.faces.size(), "edge") + ", tag " + std::to_string(data.tag));
  ImGui::PopID();
  if (pressed) context.emit(action::SelectMarkers{{marker}, ImGui::GetIO().KeyCtrl});
  if (over && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    context.emit(action::FitMarkers{{marker}});

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(start.x + size.x, start.y + size.y);
  const float round = context.theme.px(4);
  if (selected) list.AddRectFilled(start, end, palette().accent_soft, round);
  if (over || lit) list.AddRectFilled(start, end, faded(palette().accent, 0.07f), round);
  const float middle = (start.y + end.y) / 2;
  list.AddRectFilled(ImVec2(start.x + pad, middle - context.theme.px(6)),
                     ImVec2(start.x + pad + context.theme.px(12), middle + context.theme.px(6)),
                     marker_swatch(marker), context.theme.px(3));
  const char* role = selected ? "moves" : "fixed";
  const float role_width = ImGui::CalcTextSize(role).x + 2 * pad;
  const float name_x = start.x + pad + context.theme.px(22);
  const std::string name = ui::elided(data.name, end.x - role_width - 2 * pad - name_x);
  list.AddText(ImVec2(name_x, start.y + pad), palette().text, name.c_str());
  const ImVec2 pill(end.x - pad - role_width, start.y + pad / 2);
  if (selected)
    list.AddRectFilled(pill, ImVec2(end.x - pad, end.y - pad / 2), palette().accent, round);
  list.AddText(ImVec2(pill.x + pad, start.y + pad),
               selected ? palette().on_accent : palette().text_faint, role);
}

}  // namespace winslow::gui
