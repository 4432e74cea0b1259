#include "gui/panels/vcv/node_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <string>
#include <utility>

#include "gui/widgets/controls.h"

namespace winslow::gui {

std::string formatted(double value, const char* format) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

void draw_figure(const char* id, const char* label, const std::string& value, const char* tip,
                 ImU32 color) {
  ui::text_dim(label);
  ui::tooltip(tip);
  ImGui::SameLine();
  ui::text_right(value, color);
  ui::note(id);
}

void edit_vcv(const PanelContext& context, VcvEdit edit) {
  context.emit(action::EditVcvs{{std::move(edit)}});
}

void draw_node_hint() {
  ui::text_wrapped(
      "Click a node of the mesh, or type its number. While another tab is open, Alt+click.");
  ui::note("vcv/hint");
}

void draw_no_vcv(const std::string& why) {
  std::string text = why;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  ui::text_wrapped(text + ".");
  ui::note("vcv/none");
}

void draw_node_header(const PanelContext& context, int& typed) {
  const NodeSelection& nodes = context.session.nodes();
  const Theme& theme = context.theme;
  ui::row("Node", "Number of the node, from 0, in the order of the file. Enter inspects it.", 0.2f);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float buttons =
      ImGui::CalcTextSize("UnpinClear pins").x + 4 * style.FramePadding.x + 2 * style.ItemSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x - buttons;
  ImGui::SetNextItemWidth(std::clamp(room, theme.px(52), theme.px(86)));
  ui::number("vcv/node", typed);
  if (ImGui::IsItemDeactivatedAfterEdit()) context.emit(action::InspectNode{typed});
  const auto& node = nodes.inspected();
  ImGui::SameLine();
  const bool pinned = node && nodes.pinned(*node);
  if (ui::button("vcv/pin", pinned ? "Unpin" : "Pin",
                 {"Keep this node's virtual control volume drawn over the mesh.",
                  ui::ButtonStyle::normal, node.has_value(), 0}))
    context.emit(action::PinNodes{{*node}, !pinned});
  ImGui::SameLine();
  if (ui::button("vcv/clear_pins", "Clear pins",
                 {"Take all pinned control volumes off the mesh.", ui::ButtonStyle::normal,
                  !nodes.pinned().empty(), 0}))
    context.emit(action::PinNodes{nodes.pinned(), false});
}

}  // namespace winslow::gui
