#include "gui/panels/quality_panel.h"

#include "core/quality/mesh_change.h"
#include "gui/base/text.h"
#include "gui/panels/panels.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// A table with three columns of numbers at the right.
class Table {
 public:
  explicit Table(const Theme& theme)
      : theme_(theme),
        left_(ImGui::GetCursorPosX()),
        width_(ImGui::GetContentRegionAvail().x),
        narrow_(width_ < theme.px(280)) {
    // In a narrow panel use a smaller font, so that numbers do not overlap names.
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

/// The latest quality report of the mesh.
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

void draw_choice(const PanelContext& context) {
  ViewOptions view = context.view;
  ui::choice("quality/before", "Compare with", {"As opened", "Before last command"}, view.before,
             "What the mesh is compared with: the mesh as it was opened, or as it was before the "
             "last command. The comparison in the viewport (View) shows the same state.",
             0.32f);
  context.edit(view);
}

}  // namespace

void draw_quality(const PanelContext& context) {
  if (!context.session.document()) return ui::text_dim("No mesh is open.");
  draw_choice(context);
  const Validity* shown = context.shown ? &context.shown->validity : nullptr;
  draw_rows(context, quality_table(report_before(context), report_of(context), shown),
            "quality/table");
}

void draw_walls(const PanelContext& context) {
  if (!context.session.document()) return;
  const QualityReport& now = report_of(context);
  if (now.walls.walls.empty() || !ui::section("section/walls", "Walls")) return;
  const QualityReport* before = report_before(context);
  draw_rows(context, wall_table(before ? &before->walls : nullptr, now.walls), "quality/walls");
}

void draw_deviation(const PanelContext& context) {
  if (!ui::section("section/deviation", "Deviation")) return;
  const auto& measured = context.session.quality().latest();
  const bool known = measured && measured->deviation;
  draw_rows(context, deviation_table(known ? &measured->deviation->change : nullptr),
            "quality/deviation");
}

namespace {

/// Which direction of change is an improvement.
enum class Better { larger, smaller, neither };

Better better(const FieldInfo& info) {
  if (!info.judged) return Better::neither;
  return info.larger_is_better ? Better::larger : Better::smaller;
}

using Text = std::string (*)(double);

/// Three significant digits, narrow enough for a column whatever the unit.
std::string wall_number(double value) {
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 0.01 && size < 1000);
  return formatted(value, plain ? "%.3g" : "%.2e");
}

/// text: formats the numbers.
QualityRow row_of(const char* name, const double* before, double now, Better better,
                  Text text = table_number) {
  QualityRow row;
  row.name = name;
  // NaN: no element has a finite value.
  row.now = std::isnan(now) ? "-" : text(now);
  row.before = before && !std::isnan(*before) ? text(*before) : "-";
  // Omit a change that is not visible in the displayed numbers.
  if (!before || row.before == row.now || !std::isfinite(*before) || !std::isfinite(now))
    return row;
  const double change = now - *before;
  row.change = (change > 0 ? "+" : "\xE2\x88\x92") + text(std::abs(change));
  if (better != Better::neither) row.verdict = (change > 0) == (better == Better::larger) ? 1 : -1;
  return row;
}

QualityRow title_of(std::string name, std::string tip) {
  return {std::move(name), std::move(tip), true, {}, {}, {}, 0, false};
}

/// The smallest value over all elements, while a solver moves some of them. of_movable: that of the
/// elements that can move, now; report: measured earlier, in which the others were as they are.
double smallest_of_all(const QualityReport::PerMetric& report, double of_movable) {
  const bool held = report.statistics.min < report.movable.min;
  return held ? std::min(report.statistics.min, of_movable) : of_movable;
}

QualityRow fixed_row(const QualityReport& now) {
  QualityRow row;
  row.name = "Cannot move";
  row.tip =
      "Elements of which all nodes lie on the boundary. No smoothing changes them, unless nodes of "
      "the boundary slide. They are in the numbers above.";
  row.now = grouped(now.all_on_boundary);
  row.before = row.now;
  return row;
}

QualityRow inverted_row(const QualityReport* before, Index now) {
  QualityRow row;
  row.name = "Inverted";
  row.tip =
      "Elements of which some part has no positive area or volume. A solver cannot use such a "
      "mesh.";
  row.now = grouped(now);
  row.alarming = now > 0;
  row.before = before ? grouped(before->inverted) : "-";
  if (!before || before->inverted == now) return row;
  const Index change = now - before->inverted;
  row.change = (change > 0 ? "+" : "\xE2\x88\x92") + grouped(std::abs(change));
  row.verdict = change < 0 ? 1 : -1;
  return row;
}

/// The elements of a surface mesh that lie behind folded edges.
QualityRow folded_row(const SurfaceFolds* before, const SurfaceFolds& now) {
  QualityRow row;
  row.name = "Folded";
  row.tip =
      "Elements of a surface mesh that lie behind edges at which it turns back on itself, by more "
      "than 150 degrees. A mesh that was read from a file has no other side to tell that they face "
      "backwards: they do not count as inverted unless a reference surface is given.";
  row.now = grouped(now.elements);
  row.alarming = now.any();
  row.before = before ? grouped(before->elements) : "-";
  if (!before || before->elements == now.elements) return row;
  const Index change = now.elements - before->elements;
  row.change = (change > 0 ? "+" : "\xE2\x88\x92") + grouped(std::abs(change));
  row.verdict = change < 0 ? 1 : -1;
  return row;
}

/// A quantile of a distribution.
struct Place {
  const char* name;
  double Quantiles::*of;
};
constexpr std::array whole_spread{Place{"min", &Quantiles::min}, Place{"5 %", &Quantiles::low},
                                  Place{"median", &Quantiles::median},
                                  Place{"95 %", &Quantiles::high}, Place{"max", &Quantiles::max}};
constexpr std::array upper_end{whole_spread[3], whole_spread[4]};

/// A measure of the cells at walls or beyond.
struct WallRows {
  const char* name;
  const char* tip;
  Quantiles WallReport::*of;
  std::span<const Place> places;
  Better better;
};
constexpr std::array wall_rows{
    WallRows{
        "First height",
        "Height of the cells at the walls of bodies, at the nodes of the wall, in units of the "
        "mesh.",
        &WallReport::first_height, whole_spread, Better::neither},
    WallRows{"Tilt of the first edge",
             "Degrees by which the first edges off a wall deviate from its normal.",
             &WallReport::tilt, upper_end, Better::smaller},
    WallRows{
        "Growth off the wall",
        "Ratio of the heights of consecutive cells in the columns of quadrilaterals on a wall, in "
        "space of prisms and hexahedra, the larger over the smaller.",
        &WallReport::growth, upper_end, Better::neither},
    WallRows{"Size ratio",
             "Square root of the ratio of the areas of two elements that share an edge, in space "
             "cube root of that of the volumes of two that share a face, the larger over the "
             "smaller; of the whole mesh.",
             &WallReport::size_ratio, upper_end, Better::neither}};

void add_wall_rows(const WallReport* before, const WallReport& now, const WallRows& what,
                   std::vector<QualityRow>& rows) {
  const Quantiles& n = now.*what.of;
  if (n.count == 0) return;
  rows.push_back(title_of(what.name, what.tip));
  const Quantiles* b = before && (before->*what.of).count > 0 ? &(before->*what.of) : nullptr;
  for (const Place& place : what.places) {
    rows.push_back(
        row_of(place.name, b ? &(b->*place.of) : nullptr, n.*place.of, what.better, wall_number));
  }
}

/// Adds the node-by-node ratio of first heights, which the two distributions do not show.
void add_height_change(const WallReport& before, const WallReport& now,
                       std::vector<QualityRow>& rows) {
  const auto change = compare_first_heights(before.walls, now.walls);
  if (!change || change->ratio.count == 0) return;
  rows.push_back(title_of("First height over before",
                          "At each node of the walls, the first height over that before. Changed: "
                          "share of the nodes where it differs by more than 5 %."));
  for (const Place& place : whole_spread) {
    QualityRow& row = rows.emplace_back();
    row.name = place.name;
    row.now = wall_number(change->ratio.*place.of);
  }
  QualityRow& row = rows.emplace_back();
  row.name = "changed";
  row.now = wall_number(100 * change->off) + " %";
  row.alarming = spoils_walls(*change);
}

}  // namespace

std::vector<QualityRow> quality_table(const QualityReport* before, const QualityReport& now,
                                      const Validity* shown) {
  std::vector<QualityRow> rows;
  for (const Metric metric : reported_metrics(now.cell_dimension)) {
    const FieldInfo& info = metric_info(metric, now.cell_dimension).field;
    rows.push_back(title_of(std::string(info.label), std::string(info.help)));
    Statistics n = now.of(metric).statistics;
    if (shown && metric == Metric::normalized_jacobian)
      n.min = smallest_of_all(now.of(metric), shown->min_sine);
    const Statistics* b = before ? &before->of(metric).statistics : nullptr;
    rows.push_back(row_of("min", b ? &b->min : nullptr, n.min, better(info)));
    rows.push_back(row_of("avg", b ? &b->avg : nullptr, n.avg, better(info)));
    rows.push_back(row_of("max", b ? &b->max : nullptr, n.max, better(info)));
  }
  rows.push_back(inverted_row(before, shown ? shown->inverted : now.inverted));
  if (now.all_on_boundary > 0) rows.push_back(fixed_row(now));
  if (now.folds.any() || (before && before->folds.any()))
    rows.push_back(folded_row(before ? &before->folds : nullptr, now.folds));
  return rows;
}

std::vector<QualityRow> deviation_table(const SurfaceChange* change) {
  const SurfaceChange c = change ? *change : SurfaceChange();
  const auto distance = [&](std::string name, std::string tip, double value) {
    QualityRow row{std::move(name), std::move(tip), false, {}, {}, {}, 0, false};
    // Rounding errors count as 0.
    row.now = change ? wall_number(value < 1e-14 * c.extent ? 0 : value) : "-";
    return row;
  };
  std::vector<QualityRow> rows{
      distance(
          "Largest, of the mesh now",
          "Largest distance of nodes and of the middles of edges and elements from the mesh as "
          "it was opened, in units of the mesh. On a curved surface most of it is that between "
          "chords.",
          c.from_after),
      distance("Largest, as opened", "The same of the mesh as opened, from the mesh now.",
               c.from_before),
      distance("Hausdorff distance", "The larger of these two.", c.hausdorff())};
  QualityRow relative = distance("Over the diagonal",
                                 "The Hausdorff distance over the diagonal of the mesh's box.", 0);
  const double share = c.extent > 0 ? c.hausdorff() / c.extent : 0;
  if (change) relative.now = wall_number(share < 1e-14 ? 0 : share);
  rows.push_back(relative);
  if (!c.volume_before || !c.volume_after) return rows;
  QualityRow volume =
      row_of("Enclosed volume", &*c.volume_before, *c.volume_after, Better::neither, wall_number);
  volume.tip =
      "Volume inside the closed surface, in cubed units of the mesh: as opened, now, and by "
      "how much it has changed.";
  const double percent = 100 * (*c.volume_after / *c.volume_before - 1);
  volume.change = std::abs(percent) < 1e-9 ? ""
                                           : (percent > 0 ? "+" : "\xE2\x88\x92") +
                                                 wall_number(std::abs(percent)) + " %";
  rows.push_back(volume);
  return rows;
}

std::vector<QualityRow> wall_table(const WallReport* before, const WallReport& now) {
  std::vector<QualityRow> rows;
  for (const WallRows& what : wall_rows) {
    add_wall_rows(before, now, what, rows);
    if (before && what.of == &WallReport::first_height) add_height_change(*before, now, rows);
  }
  return rows;
}

}  // namespace winslow::gui
