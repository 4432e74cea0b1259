#include "gui/panels/quality_panel.h"

#include <array>
#include <string>

#include "gui/studio/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct Row {
  Metric metric;
  const char* name;
  const char* tip;
};

constexpr std::array<Row, 3> rows{
    {{Metric::normalized_jacobian, "Normalized Jacobian",
      "Sine of every corner angle: 0.866 for an equilateral triangle, 1 for a right angle, "
      "negative where an element is inverted. Larger is better."},
     {Metric::aspect_ratio, "Aspect ratio R/2r",
      "Circumradius over twice the inradius. 1 is best. Inverted elements are left out."},
     {Metric::condition_number, "Condition number",
      "Weighted condition number of the corners. 1 is best. Inverted elements are left out."}}};

void numbers(const Statistics& s, ImU32 c) {
  for (double value : {s.min, s.avg, s.max}) {
    ImGui::TableNextColumn();
    ui::text_right(table_number(value), c);
  }
}

void header() {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  for (const char* name : {"min", "avg", "max"}) {
    ImGui::TableNextColumn();
    ui::text_right(name, color::text_dim);
  }
}

void inverted_row(const QualityReport& before, const QualityReport& now) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("Inverted");
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  ui::text_right(grouped(before.inverted), color::text_dim);
  ImGui::TableNextColumn();
  ui::text_right(grouped(now.inverted), now.inverted > 0 ? color::danger : color::text);
}

}  // namespace

void QualityPanel::draw(const PanelContext& context) {
  if (!ui::section("section/quality", "Quality")) return;
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  draw_table(context);
  draw_worst(context);
}

void QualityPanel::draw_table(const PanelContext& context) {
  const QualityReport& loaded = context.session.document()->loaded_quality();
  const auto& measured = context.session.quality().latest();
  const QualityReport& now = measured ? measured->report : loaded;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(context.theme.px(5), context.theme.px(2)));
  constexpr auto flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;
  if (ImGui::BeginTable("quality", 4, flags)) {
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch);
    for (const char* name : {"min", "avg", "max"})
      ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed, context.theme.px(62));
    header();
    for (const Row& row : rows) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row.name);
      ui::tooltip(row.tip);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ui::text_dim("   loaded");
      numbers(loaded.of(row.metric).statistics, color::text_dim);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted("   now");
      numbers(now.of(row.metric).statistics, color::text);
    }
    inverted_row(loaded, now);
    ImGui::EndTable();
    ui::note("quality/table");
  }
  ImGui::PopStyleVar();
}

void QualityPanel::draw_worst(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  if (!measured) return;
  const Metric metric = context.view.color && *context.view.color != Metric::area
                            ? *context.view.color
                            : Metric::normalized_jacobian;
  const auto& worst = measured->report.of(metric).worst;
  if (worst.empty()) return;
  ui::text_dim("Worst elements, by " + std::string(metric_label(metric)));
  const Bounds all = bounds(context.session.document()->state().mesh);
  for (std::size_t i = 0; i < worst.size() && i < 5; ++i) {
    const std::string label =
        "#" + std::to_string(worst[i].element) + "   " + table_number(worst[i].value);
    const std::string id = "quality/worst/" + std::to_string(i);
    if (ui::button(id, label, {"Show this element.", ui::ButtonStyle::flat, true, 0}))
      context.emit(action::LookAt{worst[i].centre, 0.002 * all.size().norm()});
    if (i % 2 == 0 && i + 1 < worst.size() && i + 1 < 5)
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.5f);
  }
}

}  // namespace winslow::gui
