#include "gui/panels/panels.h"

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/view/navigation/go_to.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

const char* hint_of(MeshKind kind) {
  if (kind == MeshKind::plane) return "n123, e45, 0.5, 0.1 ...";
  return kind == MeshKind::volume ? "n123, e45, f12, 0.5, 0.1, 2 ..."
                                  : "n123, e45, 0.5, 0.1, 2 ...";
}

/// Goes to a node, an element or a face by its id, and describes it.
class GoToPanel {
 public:
  void draw(const PanelContext& context) {
    if (!context.session.document()) return;
    // Unfold the section if the field was requested by its key.
    if (context.view_state.go_to_wanted) ui::unfold("section/go_to");
    if (!ui::section("section/go_to", "Go to")) return;
    draw_field(context);
    if (!error_.empty()) {
      ui::text_wrapped(error_, palette().danger);
      ui::note("go_to/error");
    }
    draw_item(context);
  }

 private:
  void draw_field(const PanelContext& context) {
    constexpr const char* tip =
        "n123 goes to a node, e45 to an element, 0.5, 0.1 to the node nearest to a point, worst 3 "
        "to an entry of the list above, the name of a marker to its first node; of a volume mesh "
        "f12 to a face, wing 12 to that face of a marker. Ctrl+G comes here.";
    if (context.view_state.go_to_wanted) ImGui::SetKeyboardFocusHere();
    const float go = context.theme.px(44);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - go -
                            ImGui::GetStyle().ItemInnerSpacing.x);
    // Newly typed text replaces the previous id.
    bool wanted = ImGui::InputTextWithHint(
        "##go_to", hint_of(context.session.kind()), text_.data(), text_.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ui::note("go_to/field");
    ui::tooltip(tip);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    wanted |=
        ui::button("go_to/go", "Go", {"Go there (Enter).", ui::ButtonStyle::normal, true, go});
    if (!wanted) return;
    try {
      context.emit(action::GoTo{parse_item(text_.data(), context.session, context.view)});
      error_.clear();
    } catch (const UsageError& error) {
      error_ = error.what();
    }
  }

  void draw_item(const PanelContext& context) {
    const auto& focus = context.view_state.focus;
    if (!focus || !exists(*focus, context.session)) return;
    const float left = ImGui::GetCursorPosX();
    ImGui::BeginGroup();
    bool first = true;
    if (described_ != focus || shape_ != context.session.shape() ||
        generation_ != context.session.generation()) {
      lines_ = describe_item(*focus, context.session);
      described_ = focus;
      shape_ = context.session.shape();
      generation_ = context.session.generation();
    }
    for (const auto& [name, value] : lines_) {
      if (first)
        ui::text_colored(palette().text, name);
      else
        ui::text_dim(name);
      ImGui::SameLine(left + context.theme.px(150));
      ui::text_wrapped(value);
      first = false;
    }
    ImGui::EndGroup();
    ui::note("go_to/item");
    if (ui::button("go_to/again", "Show", {"Bring it into view again.", ui::ButtonStyle::normal}))
      context.emit(action::GoTo{focus});
    ImGui::SameLine();
    if (ui::button("go_to/clear", "Clear", {"Highlight nothing.", ui::ButtonStyle::normal}))
      context.emit(action::GoTo{});
  }

  std::array<char, 128> text_{};
  std::string error_;
  // Description of an item, valid until the item or the mesh changes.
  std::optional<MeshItem> described_;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::vector<std::pair<std::string, std::string>> lines_;
};

void draw_threshold(const PanelContext& context, Isolation& isolation) {
  const std::string metric(field_info(*context.view.color).label);
  constexpr const char* tip = "Which elements stay. The line in the legend can be dragged, too.";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ui::row(metric, tip, 0.5f);
  std::size_t side = isolation.above ? 1 : 0;
  ImGui::SetNextItemWidth(context.theme.px(72));
  ui::combo("isolate/side", {"below", "above"}, side, tip);
  isolation.above = side == 1;
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  double threshold = isolation.threshold;
  if (ui::number("isolate/threshold", threshold, tip, "%.4g") && std::isfinite(threshold))
    isolation.threshold = threshold;
  constexpr const char* rest_tip = "How much of the other elements is seen; 0 hides them.";
  ui::row("Others", rest_tip, 0.5f);
  int percent = static_cast<int>(std::lround(100 * isolation.rest));
  if (ImGui::SliderInt("##isolate/rest", &percent, 0, 60, "%d %%"))
    isolation.rest = percent / 100.0;
  ui::note("isolate/rest");
  ui::tooltip(rest_tip);
  const auto& measured = context.session.quality().latest();
  if (measured && measured->field == context.view.color)
    ui::text_dim(counted(isolated_count(measured->values, isolation), "element") + " of " +
                 grouped(static_cast<long long>(measured->values.size())));
  ui::note("isolate/count");
}

/// The list of the worst elements: a click goes to one.
class WorstPanel {
 public:
  void draw(const PanelContext& context) {
    if (!context.session.document() || !ui::section("section/worst", "Worst elements")) return;
    draw_choices(context);
    draw_steps(context);
    draw_list(context);
  }

 private:
  void draw_choices(const PanelContext& context) {
    ViewOptions view = context.view;
    const std::vector<ElementField> fields = rankings(context.session.kind());
    std::vector<std::string> names{"As coloured"};
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      names.emplace_back(field_info(fields[k]).label);
      if (view.worst_by == fields[k]) chosen = k + 1;
    }
    if (ui::choice("worst/metric", "By", names, chosen,
                   "The metric, or the measure of cells at walls, by which elements are worst. "
                   "First heights: the smallest; over before: those that have changed by the "
                   "largest factor.",
                   0.32f))
      view.worst_by = chosen == 0 ? std::nullopt : std::optional(fields[chosen - 1]);
    static constexpr std::array<ui::Named<int>, 4> lengths{
        {{10, "10"}, {20, "20"}, {50, "50"}, {100, "100"}}};
    ui::choice("worst/count", "Length", lengths, view.worst_count, "How many elements are listed.",
               0.32f, lengths.size());
    if (meshes_in_space.contains(context.session.kind()))
      ui::checkbox("worst/through", "See them through the mesh", view.space.worst,
                   "Draw the elements of this list in orange, through what hides them.");
    context.edit(view);
  }

  void draw_steps(const PanelContext& context) {
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

  void draw_list(const PanelContext& context) {
    // The rows must not change while the mouse is over the list.
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
    // Also while a mouse button is held on a row, since a click acts on release.
    hovered_ = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::EndChild();
    ui::note("worst/list");
    ImGui::PopStyleVar();
  }

  std::vector<WorstElement> list_;  // as drawn
  std::uint64_t list_generation_ = 0;
  ElementField list_field_ = Metric::normalized_jacobian;
  bool hovered_ = false;                 // in the last frame
  std::optional<MeshItem> scrolled_to_;  // the list is scrolled once to a newly focused item
};

}  // namespace

/// Isolates the elements on one side of a threshold of the shown metric.
void draw_isolation(const PanelContext& context) {
  if (!context.session.document() || !ui::section("section/isolate", "Isolate")) return;
  if (!context.view.color) return ui::text_dim("Colour the elements by a metric first (View).");
  ViewOptions view = context.view;
  ui::checkbox("isolate/on", "Isolate elements", view.isolation.on,
               "Draw the elements beyond a threshold of the metric shown in full, "
               "the others faint or not at all (I).");
  if (view.isolation.on) draw_threshold(context, view.isolation);
  context.edit(view);
}

DrawPanel go_to_panel() { return panel_of<GoToPanel>(); }
DrawPanel worst_panel() { return panel_of<WorstPanel>(); }

}  // namespace winslow::gui
