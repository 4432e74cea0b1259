#include "gui/panels/vcv/vcv_parts.h"

#include <cctype>
#include <cstdio>

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

void LabelPlacer::block(const ImVec2& centre, float half) {
  taken_.push_back(
      {ImVec2(centre.x - half, centre.y - half), ImVec2(centre.x + half, centre.y + half)});
}

bool LabelPlacer::is_free(const Rect& rect) const {
  const bool inside =
      rect.min.x >= min_.x && rect.min.y >= min_.y && rect.max.x <= max_.x && rect.max.y <= max_.y;
  if (!inside) return false;  // nor are numbers that are none
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) {
    return rect.min.x < other.max.x && rect.max.x > other.min.x && rect.min.y < other.max.y &&
           rect.max.y > other.min.y;
  });
}

bool LabelPlacer::place(const ImVec2& centre, const std::string& text, ImU32 color,
                        ImU32 background) {
  const ImVec2 size = font_->CalcTextSizeA(font_->FontSize, 1e6f, 0, text.c_str());
  const Rect rect{ImVec2(centre.x - size.x / 2 - 1, centre.y - size.y / 2),
                  ImVec2(centre.x + size.x / 2 + 1, centre.y + size.y / 2)};
  if (!is_free(rect)) return false;
  taken_.push_back(rect);
  if (background != 0) list_.AddRectFilled(rect.min, rect.max, background, 2);
  list_.AddText(font_, font_->FontSize, ImVec2(rect.min.x + 1, rect.min.y), color, text.c_str());
  return true;
}

}  // namespace winslow::gui
