#include "gui/panels/worst_panel.h"

#include <algorithm>
#include <array>
#include <string>

#include "gui/base/text.h"
#include "gui/view/navigation/worst_list.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr std::array<int, 4> counts{10, 20, 50, 100};

}  // namespace

void WorstPanel::draw(const PanelContext& context) {
  if (!context.session.document() || !ui::section("section/worst", "Worst elements")) return;
  draw_choices(context);
  draw_steps(context);
  draw_list(context);
}

void WorstPanel::draw_choices(const PanelContext& context) {
  ViewOptions view = context.view;
  bool changed = false;
  const bool in_space = context.session.in_space();
  const std::vector<ElementField> fields = rankings(context.session.kind());
  std::vector<std::string> names{"As coloured"};
  std::size_t chosen = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    names.emplace_back(field_info(fields[k]).label);
    if (view.worst_by == fields[k]) chosen = k + 1;
  }
  constexpr const char* metric_tip =
      "The metric, or the measure of cells at walls, by which elements are worst. First heights: "
      "the smallest; over before: those that have changed by the largest factor.";
  ui::row("By", metric_tip, 0.32f);
  if (ui::combo("worst/metric", names, chosen, metric_tip)) {
    view.worst_by = chosen == 0 ? std::nullopt : std::optional(fields[chosen - 1]);
    changed = true;
  }
  auto length =
      static_cast<std::size_t>(std::ranges::find(counts, view.worst_count) - counts.begin());
  ui::row("Length", "How many elements are listed.", 0.32f);
  if (ui::combo("worst/count", {"10", "20", "50", "100"}, length)) {
    view.worst_count = counts[length];
    changed = true;
  }
  if (in_space)
    changed |= ui::checkbox("worst/through", "See them through the mesh", view.space.worst,
                            "Draw the elements of this list in orange, through what hides them.");
  if (changed) context.emit(action::EditView{difference(context.view, view)});
}

void WorstPanel::draw_steps(const PanelContext& context) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const auto step = [&](const char* id, const char* label, const char* tip, int by) {
    const auto item = next_worst(context.session, context.view, context.view_state.focus, by);
    if (ui::button(id, label, {tip, ui::ButtonStyle::normal, item.has_value(), width}))
      context.emit(action::GoTo{item});
  };
  step("worst/previous", "Previous", "Go to the next worse element ([).", -1);
  ImGui::SameLine(0, gap);
  step("worst/next", "Next", "Go to the next element of the list (]).", 1);
}

void WorstPanel::draw_list(const PanelContext& context) {
  // A row must not become another while the mouse is about to click it.
  const auto latest = worst_elements(context.session, context.view);
  const ElementField field = worst_field(context.view, context.session.kind());
  const bool held = hovered_ && list_generation_ == context.session.generation() &&
                    list_field_ == field && !list_.empty();
  if (!held) list_.assign(latest.begin(), latest.end());
  list_generation_ = context.session.generation();
  list_field_ = field;
  const std::vector<WorstElement>& worst = list_;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const auto lines = static_cast<float>(std::clamp<std::size_t>(worst.size(), 1, 8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(8), context.theme.px(6)));
  ImGui::BeginChild("worst", ImVec2(0, lines * line + context.theme.px(12)), true);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const MeshItem item{MeshItem::Kind::element, worst[i].element};
    const bool present = context.view_state.focus == item;
    const std::string id = "quality/worst/" + std::to_string(i);
    if (ImGui::Selectable(("##" + id).c_str(), present)) context.emit(action::GoTo{item});
    ui::note(id);
    ui::tooltip("Show this element. The list stands still under the mouse.");
    if (present && scrolled_to_ != item) {
      ImGui::SetScrollHereY();
      scrolled_to_ = item;
    }
    ImGui::SameLine(context.theme.px(8));
    ui::text_dim(std::to_string(i + 1));
    ImGui::SameLine(context.theme.px(44));
    ImGui::TextUnformatted(("e" + std::to_string(worst[i].element)).c_str());
    ImGui::SameLine();
    // Deviations are small numbers in units of the mesh.
    ui::text_right(field.surface() ? short_number(worst[i].value) : table_number(worst[i].value),
                   palette().text);
  }
  const auto& measured = context.session.quality().latest();
  const bool waits = !measured || (field.surface() && !measured->deviation);
  if (worst.empty()) ui::text_dim(waits ? "Measuring ..." : "No element has it.");
  // Also while a row is held down: it is the click's end that counts.
  hovered_ = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  ImGui::EndChild();
  ui::note("worst/list");
  ImGui::PopStyleVar();
}

}  // namespace winslow::gui
