#include "gui/panels/quality_panel.h"

#include <array>
#include <string>

#include "gui/panels/quality_table.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Lines of a table with three columns of numbers at the right.
class Table {
 public:
  explicit Table(const Theme& theme)
      : theme_(theme),
        left_(ImGui::GetCursorPosX()),
        width_(ImGui::GetContentRegionAvail().x),
        narrow_(width_ < theme.px(280)) {
    // Smaller letters rather than numbers over names.
    ImGui::PushFont(narrow_ ? theme.small : theme.regular);
  }
  ~Table() { ImGui::PopFont(); }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  void label(const std::string& text, bool title) {
    if (!title) ImGui::SetCursorPosX(left_ + theme_.px(12));
    ui::text_colored(title ? palette().text : palette().text_dim, text);
  }
  void cell(int column, const std::string& text, ImU32 c) {
    const float step = theme_.px(narrow_ ? narrow_column : column_width);
    const float end = left_ + width_ - step * static_cast<float>(2 - column);
    ImGui::SameLine();
    ImGui::SetCursorPosX(end - ImGui::CalcTextSize(text.c_str()).x);
    ui::text_colored(c, text);
  }

 private:
  static constexpr float column_width = 70, narrow_column = 58;
  const Theme& theme_;
  float left_, width_;
  bool narrow_;
};

ImU32 color_of(int verdict) {
  if (verdict == 0) return palette().text_dim;
  return verdict > 0 ? palette().success : palette().danger;
}

/// What the mesh is like now: as measured last.
const QualityReport& report_of(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  return measured ? measured->report : context.session.document()->loaded_quality();
}

const QualityReport* report_before(const PanelContext& context) {
  return context.before ? context.before->report() : nullptr;
}

void draw_row(Table& table, const QualityRow& row) {
  table.label(row.name, row.title || !row.tip.empty());
  ui::tooltip(row.tip);
  if (row.title) return;
  table.cell(0, row.before, palette().text_dim);
  table.cell(1, row.now, row.alarming ? palette().danger : palette().text);
  table.cell(2, row.change, color_of(row.verdict));
  ui::tooltip(row.verdict == 0  ? ""
              : row.verdict > 0 ? "Better than before."
                                : "Worse than before.");
}

/// id: of the whole table.
void draw_rows(const PanelContext& context, const std::vector<QualityRow>& rows, const char* id) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.theme.px(8), context.theme.px(4)));
  ImGui::BeginGroup();
  {
    Table table(context.theme);
    table.label("", true);
    const std::array<const char*, 3> heads{"before", "now", "change"};
    for (int column = 0; column < 3; ++column)
      table.cell(column, heads[static_cast<std::size_t>(column)], palette().text_dim);
    for (const QualityRow& row : rows) draw_row(table, row);
  }
  ImGui::EndGroup();
  ui::note(id);
  ImGui::PopStyleVar();
}

}  // namespace

void QualityPanel::draw(const PanelContext& context) {
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  draw_choice(context);
  const Validity* shown = context.shown ? &context.shown->validity : nullptr;
  draw_rows(context, quality_table(report_before(context), report_of(context), shown),
            "quality/table");
}

void QualityPanel::draw_choice(const PanelContext& context) {
  auto which = static_cast<std::size_t>(context.view.before);
  constexpr const char* tip =
      "What the mesh is compared with: the mesh as it was opened, or as it was before the last "
      "command. The comparison in the viewport (View) shows the same state.";
  ui::row("Compare with", tip, 0.32f);
  if (!ui::combo("quality/before", {"As opened", "Before last command"}, which, tip)) return;
  context.edit_view([&](ViewOptions& view) { view.before = static_cast<BeforeState>(which); });
}

void WallPanel::draw(const PanelContext& context) {
  if (!context.session.document()) return;
  const QualityReport& now = report_of(context);
  if (now.walls.walls.empty() || !ui::section("section/walls", "Walls")) return;
  const QualityReport* before = report_before(context);
  draw_rows(context, wall_table(before ? &before->walls : nullptr, now.walls), "quality/walls");
}

void DeviationPanel::draw(const PanelContext& context) {
  if (context.session.kind() != MeshKind::surface) return;
  if (!ui::section("section/deviation", "Deviation")) return;
  const auto& measured = context.session.quality().latest();
  const bool known = measured && measured->deviation;
  draw_rows(context, deviation_table(known ? &measured->deviation->change : nullptr),
            "quality/deviation");
}

}  // namespace winslow::gui
