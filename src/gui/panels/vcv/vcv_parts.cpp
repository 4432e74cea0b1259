#include "gui/panels/vcv/vcv_parts.h"

#include <cctype>

#include "gui/widgets/controls.h"

namespace winslow::gui {

void draw_figure(const char* id, const char* label, const std::string& value, const char* tip,
                 ImU32 color) {
  ui::figure(label, value, tip, color);
  ui::note(id);
}

void edit_vcv(const PanelContext& context, VcvEdit edit) {
  context.emit(action::EditVcvs{{std::move(edit)}});
}

void edit_length(const PanelContext& context, VcvEdit edit, std::size_t edge, double length) {
  if (!(length > 0) || !std::isfinite(length) || length == edit.lengths[edge]) return;
  edit.lengths[edge] = length;
  edit_vcv(context, std::move(edit));
}

void take_outcome(const PanelContext& context, const VcvPlotOutcome& outcome, std::size_t& edge) {
  if (outcome.edit) context.emit(action::EditVcvs{{*outcome.edit}, true});
  if (outcome.ended) context.emit(action::EndVcvEdit{});
  if (outcome.cancelled) context.emit(action::CancelVcvEdit{});
  if (outcome.hovered && ImGui::IsMouseDown(ImGuiMouseButton_Left)) edge = *outcome.hovered;
}

std::optional<std::size_t> lit_neighbour(const PanelContext& context,
                                         std::span<const Index> neighbours,
                                         const std::optional<std::size_t>& hovered) {
  const auto& node = context.session.nodes().hovered();
  if (hovered || !node) return hovered;
  const auto found = std::ranges::find(neighbours, *node);
  if (found == neighbours.end()) return std::nullopt;
  return static_cast<std::size_t>(found - neighbours.begin());
}

void draw_resets(const PanelContext& context, const VcvEdit& reset, bool edited,
                 const std::vector<Index>& all_edited, const std::array<const char*, 2>& tips) {
  if (ui::button("vcv/reset", "Reset", {tips[0], ui::ButtonStyle::normal, edited, 0}))
    edit_vcv(context, reset);
  ImGui::SameLine();
  if (ui::button("vcv/reset_all", "Reset all",
                 {tips[1], ui::ButtonStyle::normal, !all_edited.empty(), 0})) {
    std::vector<VcvEdit> all;
    for (const Index node : all_edited) all.push_back({node, {}, {}, {}});
    context.emit(action::EditVcvs{std::move(all)});
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::string count = grouped(static_cast<long long>(all_edited.size()));
  ui::text_dim((all_edited.empty() ? "none" : count) + " edited");
}

void draw_number(ImDrawList& list, const Theme& theme, const ImVec2& at, std::size_t neighbour,
                 bool lit) {
  const std::string number = std::to_string(neighbour + 1);
  ImFont* font = theme.small;
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, number.c_str());
  list.AddText(font, font->FontSize, ImVec2(at.x - size.x / 2, at.y - size.y / 2),
               lit ? IM_COL32_WHITE : palette().text, number.c_str());
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
  if (!inside) return false;  // also rejects NaN
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
