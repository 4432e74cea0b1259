#include "gui/panels/forms/quality_limits_form.h"

#include <algorithm>

#include "core/command/option_tables.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

/// Of the row: names of metrics are long, their values short.
constexpr float name_share = 0.72f;

constexpr const char* tip =
    "The motion ends before any element is worse than this: the body stays where it got to, and "
    "the line above the mesh says how far that is. A drag shows what lies beyond; let go, the body "
    "goes back to the limit.";

bool limit_row(const std::string& id, const Option& option, std::optional<double>& limit,
               double first) {
  const std::string row_tip = std::string(option.help) + '.';
  bool on = limit.has_value();
  const float start = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  bool changed = checkbox(id + "/on", std::string(option.label), on, row_tip);
  if (changed) limit = on ? std::optional(first) : std::nullopt;
  if (!limit) return changed;
  ImGui::SameLine(start + width * name_share);
  ImGui::SetNextItemWidth(-FLT_MIN);
  // As high as the switch: one line of text for all rows.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ImGui::GetStyle().FramePadding.x, 3));
  changed |= number(id, *limit, row_tip, option.unit == "degrees" ? "%.6g\xC2\xB0" : "%.6g");
  ImGui::PopStyleVar();
  if (const std::string fault = fault_of(option); !fault.empty())
    text_colored(palette().danger, elided(fault, ImGui::GetContentRegionAvail().x));
  return changed;
}

}  // namespace

bool quality_limits_form(const std::string& prefix, QualityFloor& floor, int cell_dimension,
                         bool follows_path) {
  const auto given =
      std::ranges::count_if(floor.limits, [](const auto& l) { return l.has_value(); });
  const std::string title =
      "Limits of quality" + (given > 0 ? " (" + std::to_string(given) + ")" : std::string());
  if (!fold(prefix + "/limits", title, tip)) return false;
  if (given > 0 && !follows_path) {
    text_wrapped(
        "Limits are kept on a path: choose the method \"Path following\", automatic steps and "
        "smoothing afterwards.");
    note(prefix + "/limits/path");
  }
  bool changed = false;
  const OptionTable table = option_table(floor);
  const auto& reported = reported_metrics(cell_dimension);
  for (std::size_t m = 0; m < limited_metrics().size(); ++m) {
    const Metric metric = limited_metrics()[m];
    if (std::ranges::find(reported, metric) == reported.end()) continue;
    changed |= limit_row(prefix + "/min_quality_" + std::string(table[m].key), table[m],
                         floor.limits[m], metric_info(metric, cell_dimension).field.threshold);
  }
  return changed;
}

}  // namespace winslow::gui::ui
