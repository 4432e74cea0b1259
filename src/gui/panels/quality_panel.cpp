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

/// Lines of a table whose labels may run on beneath the heads of the columns.
class Table {
 public:
  explicit Table(const Theme& theme)
      : theme_(theme), left_(ImGui::GetCursorPosX()), width_(ImGui::GetContentRegionAvail().x) {}

  void label(const char* text, ImU32 c) { ui::text_colored(c, text); }
  /// One of three columns at the right.
  void cell(int column, const std::string& text, ImU32 c) {
    const float end = left_ + width_ - theme_.px(column_width) * static_cast<float>(2 - column);
    ImGui::SameLine();
    ImGui::SetCursorPosX(end - ImGui::CalcTextSize(text.c_str()).x);
    ui::text_colored(c, text);
  }
  void numbers(const char* text, const Statistics& s, ImU32 c) {
    ImGui::SetCursorPosX(left_ + theme_.px(12));
    label(text, c);
    cell(0, table_number(s.min), c);
    cell(1, table_number(s.avg), c);
    cell(2, table_number(s.max), c);
  }

 private:
  static constexpr float column_width = 66;
  const Theme& theme_;
  float left_, width_;
};

/// Brings an element into view with some of what surrounds it.
void show_element(const PanelContext& context, Index element) {
  const Bounds box = bounds(context.session.coordinates(), context.topology()->element(element));
  context.emit(action::LookAt{box.centre(), 6 * box.size().norm()});
}

}  // namespace

void QualityPanel::draw(const PanelContext& context) {
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
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.theme.px(8), context.theme.px(4)));
  ImGui::BeginGroup();
  Table table(context.theme);
  table.label("", palette().text_dim);
  for (int column = 0; column < 3; ++column)
    table.cell(column, std::array{"min", "avg", "max"}[static_cast<std::size_t>(column)],
               palette().text_dim);
  for (const Row& row : rows) {
    table.label(row.name, palette().text);
    ui::tooltip(row.tip);
    table.numbers("as loaded", loaded.of(row.metric).statistics, palette().text_dim);
    table.numbers("now", now.of(row.metric).statistics, palette().text);
  }
  table.label("Inverted elements", palette().text);
  table.cell(1, grouped(loaded.inverted), palette().text_dim);
  table.cell(2, grouped(now.inverted), now.inverted > 0 ? palette().danger : palette().text);
  ui::tooltip("As loaded, and now.");
  ImGui::EndGroup();
  ui::note("quality/table");
  ImGui::PopStyleVar();
}

void QualityPanel::draw_worst(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  if (!measured) return;
  const Metric* shown = context.view.color ? context.view.color->metric() : nullptr;
  const Metric metric = shown && *shown != Metric::area ? *shown : Metric::normalized_jacobian;
  const auto& worst = measured->report.of(metric).worst;
  if (worst.empty()) return;
  ui::text_dim("Worst elements, by " + std::string(metric_label(metric)));
  for (std::size_t i = 0; i < worst.size() && i < 5; ++i) {
    const std::string label =
        "#" + std::to_string(worst[i].element) + "   " + table_number(worst[i].value);
    const std::string id = "quality/worst/" + std::to_string(i);
    if (ui::button(id, label, {"Show this element.", ui::ButtonStyle::flat, true, 0}))
      show_element(context, worst[i].element);
    if (i % 2 == 0 && i + 1 < worst.size() && i + 1 < 5)
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.5f);
  }
}

}  // namespace winslow::gui
