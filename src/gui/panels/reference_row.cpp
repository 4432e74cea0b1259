#include "gui/panels/reference_row.h"

#include <imgui.h>

#include <algorithm>

#include "gui/widgets/controls.h"

namespace winslow::gui {

ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading) {
  std::string tip =
      "The surface that nodes slide on: that of the mesh as it is, or that of a file, from CAD or "
      "a scan, onto which they are put first. It must be in the unit of the mesh and lie where the "
      "mesh is, and be at least as fine: between its nodes its shape is a guess. Click to choose a "
      "file.";
  if (!name.empty()) tip = name + "\n" + tip;
  ui::row("Reference surface", tip);
  const std::string given = std::filesystem::path(name).filename().string();
  const std::string label = !reading.empty() ? "Reading " + reading.filename().string() + " ..."
                            : name.empty()   ? "The mesh's own"
                                             : given;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const bool clears = !name.empty() || !reading.empty();
  const float side = clears ? ImGui::GetFrameHeight() + gap : 0;
  const float room = std::max(ImGui::GetContentRegionAvail().x - side, theme.px(40));
  const float within = room - 2 * ImGui::GetStyle().FramePadding.x;
  if (ui::button(id, ui::elided(label, within), {.tooltip = tip, .width = room}))
    return ReferenceAsk::choose;
  if (!clears) return ReferenceAsk::nothing;
  ImGui::SameLine(0, gap);
  const bool clear = ui::button(id + "_none", "x",
                                {.tooltip = "Nodes slide on the mesh's own surface again.",
                                 .width = ImGui::GetFrameHeight()});
  return clear ? ReferenceAsk::clear : ReferenceAsk::nothing;
}

}  // namespace winslow::gui
